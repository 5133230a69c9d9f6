//! Texts of a language as an expression, and the automaton that accepts them byte by byte.
//!
//! Enters: a [`Pattern`]. Leaves: an [`Automaton`], which says after each byte which bytes may follow, whether the text may
//! end, and how many bytes it still takes to end it. The invariant: repetitions are bounded, so the automaton has no loop
//! and every text ends.

use std::collections::HashSet;

/// A set of texts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Pattern {
    /// One text.
    Literal(String),
    /// A text of each part, one after the other.
    Sequence(Vec<Pattern>),
    /// A text of one of the parts. Without parts there is no text.
    Choice(Vec<Pattern>),
    /// Up to `most` texts of the part, one after the other.
    Repeat {
        /// The part.
        part: Box<Pattern>,
        /// Largest number of repetitions.
        most: usize,
    },
}

impl Pattern {
    /// One text.
    pub fn text(text: &str) -> Self {
        Self::Literal(text.to_owned())
    }

    /// One of some texts.
    pub fn one_of<T: AsRef<str>>(texts: impl IntoIterator<Item = T>) -> Self {
        Self::Choice(texts.into_iter().map(|text| Self::text(text.as_ref())).collect())
    }

    /// The empty text or one of this pattern.
    #[must_use]
    pub fn optional(self) -> Self {
        self.up_to(1)
    }

    /// Up to `most` texts of this pattern, one after the other.
    #[must_use]
    pub fn up_to(self, most: usize) -> Self {
        Self::Repeat { part: Box::new(self), most }
    }

    /// One to `most` texts of this pattern with a separator between them.
    #[must_use]
    pub fn list(self, separator: &str, most: usize) -> Self {
        let further = Self::Sequence(vec![Self::text(separator), self.clone()]);
        Self::Sequence(vec![self, further.up_to(most.saturating_sub(1))])
    }
}

/// Accepts the texts of a pattern: a nondeterministic automaton over bytes (Thompson 1968).
#[derive(Debug, Clone)]
pub struct Automaton {
    /// A node leads only to nodes before it.
    nodes: Vec<Node>,
    /// Bytes from each node to the end; `u32::MAX` where no text leads to it.
    bytes_to_end: Vec<u32>,
    start: usize,
}

#[derive(Debug, Clone)]
enum Node {
    End,
    Byte(u8, usize),
    Fork(Vec<usize>),
}

/// Where an automaton may be after some bytes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct States {
    /// The bytes that may follow, ascending, each with a node after it.
    edges: Vec<(u8, usize)>,
    /// The fewest bytes to the end; `u32::MAX` where nothing leads there.
    bytes_to_end: u32,
}

impl States {
    /// Whether no text of the pattern begins with the bytes so far.
    pub fn is_empty(&self) -> bool {
        self.bytes_to_end == u32::MAX
    }

    /// The bytes that may follow, ascending.
    pub fn next_bytes(&self) -> Vec<u8> {
        let mut bytes: Vec<u8> = self.edges.iter().map(|(byte, _)| *byte).collect();
        bytes.dedup();
        bytes
    }

    /// Whether the text may end here.
    pub fn may_end(&self) -> bool {
        self.bytes_to_end == 0
    }

    /// The fewest bytes that complete the text; `None` where nothing does.
    pub fn bytes_to_end(&self) -> Option<usize> {
        (!self.is_empty()).then_some(self.bytes_to_end as usize)
    }
}

impl Automaton {
    /// The automaton of a pattern.
    pub fn new(pattern: &Pattern) -> Self {
        let mut automaton = Self { nodes: vec![Node::End], bytes_to_end: vec![0], start: 0 };
        automaton.start = automaton.add_pattern(pattern, 0);
        automaton
    }

    /// Whether the pattern has this text.
    pub fn accepts(&self, text: &str) -> bool {
        text.bytes().fold(self.start(), |states, byte| self.after(&states, byte)).may_end()
    }

    /// The states before the first byte.
    pub fn start(&self) -> States {
        self.reached(vec![self.start])
    }

    /// The states after one more byte; empty where the byte must not follow.
    pub fn after(&self, states: &States, byte: u8) -> States {
        let first = states.edges.partition_point(|(other, _)| *other < byte);
        let edges = states.edges.iter().skip(first).take_while(|(other, _)| *other == byte);
        self.reached(edges.map(|(_, next)| *next).collect())
    }

    /// The node at which a text of `pattern` begins that leads to `next`.
    fn add_pattern(&mut self, pattern: &Pattern, next: usize) -> usize {
        match pattern {
            Pattern::Literal(text) => text.bytes().rev().fold(next, |next, byte| self.add(Node::Byte(byte, next))),
            Pattern::Sequence(parts) => parts.iter().rev().fold(next, |next, part| self.add_pattern(part, next)),
            Pattern::Choice(parts) => {
                let starts = parts.iter().map(|part| self.add_pattern(part, next)).collect();
                self.add(Node::Fork(starts))
            }
            Pattern::Repeat { part, most } => (0..*most).fold(next, |after, _| {
                let start = self.add_pattern(part, after);
                self.add(Node::Fork(vec![start, next]))
            }),
        }
    }

    fn add(&mut self, node: Node) -> usize {
        let from = |next: &usize| self.bytes_to_end.get(*next).copied().unwrap_or(u32::MAX);
        let bytes = match &node {
            Node::End => 0,
            Node::Byte(_, next) => from(next).saturating_add(1),
            Node::Fork(starts) => starts.iter().map(from).min().unwrap_or(u32::MAX),
        };
        self.nodes.push(node);
        self.bytes_to_end.push(bytes);
        self.nodes.len() - 1
    }

    /// The states at some nodes: the bytes that follow, through any forks.
    fn reached(&self, mut open: Vec<usize>) -> States {
        let ends = open.iter().filter_map(|node| self.bytes_to_end.get(*node));
        let bytes_to_end = ends.copied().min().unwrap_or(u32::MAX);
        let mut seen = HashSet::new();
        let mut edges = Vec::new();
        while let Some(node) = open.pop() {
            match self.nodes.get(node) {
                Some(Node::Byte(byte, next)) => edges.push((*byte, *next)),
                Some(Node::Fork(starts)) if seen.insert(node) => open.extend(starts),
                _ => {}
            }
        }
        edges.sort_unstable();
        edges.dedup();
        States { edges, bytes_to_end }
    }
}
