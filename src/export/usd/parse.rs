//! Parser of the part of USD's text syntax that cameras need: prims with attributes, relations and metadata.

use super::super::ExportError;
use super::super::columns::bad_line;
use super::curves::SPLINE;
use super::layer::{MAX_DEPTH, Prim, Value};

#[derive(Debug, Clone, PartialEq)]
enum Token {
    Word(String),
    Text(String),
    Number(f64),
    Mark(char),
}

struct Parser {
    tokens: Vec<(usize, Token)>,
    next: usize,
}

/// Parses a layer.
pub(super) fn parse(text: &str) -> Result<Prim, ExportError> {
    let mut parser = Parser { tokens: tokens(text)?, next: 0 };
    let mut layer = Prim::default();
    if parser.take_mark('(') {
        layer.metadata = parser.entries(')', 0)?;
    }
    while parser.peek().is_some() {
        parser.statement(&mut layer, 0)?;
    }
    Ok(layer)
}

/// Characters of names, numbers and types (`xformOp:orient`, `float3[]`, `-1e-3`).
fn is_word(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '_' | ':' | '.' | '-' | '+' | '!' | '|')
}

fn tokens(text: &str) -> Result<Vec<(usize, Token)>, ExportError> {
    let mut out = Vec::new();
    let mut rest = text;
    let mut line = 1;
    while let Some(first) = rest.chars().next() {
        let len = match first {
            '#' => rest.find('\n').unwrap_or(rest.len()),
            '"' | '\'' => {
                let quote = if rest.starts_with("\"\"\"") || rest.starts_with("'''") { &rest[..3] } else { &rest[..1] };
                let inner = &rest[quote.len()..];
                let end = inner.find(quote).ok_or_else(|| bad_line(line, rest, "a closing quote"))?;
                out.push((line, Token::Text(inner[..end].to_owned())));
                end + 2 * quote.len()
            }
            '<' | '@' => {
                let close = if first == '<' { '>' } else { '@' };
                let end = rest[1..].find(close).ok_or_else(|| bad_line(line, rest, format!("a closing {close}")))?;
                out.push((line, Token::Text(rest[1..=end].to_owned())));
                end + 2
            }
            ':' => {
                out.push((line, Token::Mark(':')));
                1
            }
            c if is_word(c) => {
                let mut len = rest.find(|c: char| !is_word(c)).unwrap_or(rest.len());
                // In time samples the colon after a key is a token of its own.
                let word = &rest[..len];
                if word.ends_with(':') {
                    len -= 1;
                }
                let word = &rest[..len.max(1)];
                let number = word.parse::<f64>().ok().filter(|_| !first.is_alphabetic());
                out.push((line, number.map_or_else(|| Token::Word(word.to_owned()), Token::Number)));
                len.max(1)
            }
            c if c.is_whitespace() => c.len_utf8(),
            c => {
                out.push((line, Token::Mark(c)));
                c.len_utf8()
            }
        };
        line += rest[..len].matches('\n').count();
        rest = &rest[len..];
    }
    Ok(out)
}

impl Parser {
    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.next).map(|(_, token)| token)
    }

    fn error(&self, expected: &str) -> ExportError {
        let (line, found) = match self.tokens.get(self.next).or(self.tokens.last()) {
            Some((line, token)) => (*line, format!("{token:?}")),
            None => (1, "nothing".to_owned()),
        };
        bad_line(line, &found, expected)
    }

    fn take_mark(&mut self, mark: char) -> bool {
        let is = self.peek() == Some(&Token::Mark(mark));
        self.next += usize::from(is);
        is
    }

    fn expect(&mut self, mark: char) -> Result<(), ExportError> {
        if self.take_mark(mark) { Ok(()) } else { Err(self.error(&format!("'{mark}'"))) }
    }

    fn word(&mut self) -> Option<String> {
        let Some(Token::Word(word)) = self.peek() else { return None };
        let word = word.clone();
        self.next += 1;
        Some(word)
    }

    /// Parses a prim, an attribute, a relation or a variant set of `parent`.
    fn statement(&mut self, parent: &mut Prim, depth: usize) -> Result<(), ExportError> {
        if depth > MAX_DEPTH {
            return Err(self.error("less nesting"));
        }
        let Some(first) = self.word() else {
            if self.take_mark(';') {
                return Ok(());
            }
            return Err(self.error("a prim or an attribute"));
        };
        match first.as_str() {
            "def" | "over" | "class" => self.prim(parent, depth),
            "variantSet" => self.variant_set(depth),
            _ => self.attribute(first, parent, depth),
        }
    }

    fn prim(&mut self, parent: &mut Prim, depth: usize) -> Result<(), ExportError> {
        let mut prim = Prim { kind: self.word().unwrap_or_default(), ..Prim::default() };
        let Some(Token::Text(name)) = self.peek() else { return Err(self.error("the name of a prim")) };
        prim.name.clone_from(name);
        self.next += 1;
        if self.take_mark('(') {
            prim.metadata = self.entries(')', depth + 1)?;
        }
        self.expect('{')?;
        while !self.take_mark('}') {
            self.statement(&mut prim, depth + 1)?;
        }
        parent.children.push(prim);
        Ok(())
    }

    /// Skips a variant set, whose selected variant is stated elsewhere.
    fn variant_set(&mut self, depth: usize) -> Result<(), ExportError> {
        self.next += 1;
        self.expect('=')?;
        self.expect('{')?;
        while !self.take_mark('}') {
            self.next += 1;
            if self.take_mark('(') {
                self.entries(')', depth + 1)?;
            }
            self.expect('{')?;
            let mut skipped = Prim::default();
            while !self.take_mark('}') {
                self.statement(&mut skipped, depth + 1)?;
            }
        }
        Ok(())
    }

    /// Parses `[custom] [uniform] type name [= value] [(metadata)]`. The last word before `=` is the name.
    fn attribute(&mut self, first: String, parent: &mut Prim, depth: usize) -> Result<(), ExportError> {
        let mut name = first;
        loop {
            if self.take_mark('[') {
                self.expect(']')?;
            } else if let Some(word) = self.word() {
                name = word;
            } else {
                break;
            }
        }
        if self.take_mark('=') {
            let is_spline = name.ends_with(SPLINE);
            let value = if is_spline { self.spline()? } else { self.value(depth + 1)? };
            parent.attributes.push((name, value));
        }
        if self.take_mark('(') {
            self.entries(')', depth + 1)?;
        }
        Ok(())
    }

    /// Skips a spline, of which only the name counts.
    fn spline(&mut self) -> Result<Value, ExportError> {
        self.expect('{')?;
        let mut open = 1_usize;
        while open > 0 {
            match self.peek() {
                Some(Token::Mark('{')) => open += 1,
                Some(Token::Mark('}')) => open -= 1,
                Some(_) => {}
                None => return Err(self.error("a closing brace")),
            }
            self.next += 1;
        }
        Ok(Value::List(Vec::new()))
    }

    fn value(&mut self, depth: usize) -> Result<Value, ExportError> {
        if depth > MAX_DEPTH {
            return Err(self.error("less nesting"));
        }
        for (open, close) in [('(', ')'), ('[', ']')] {
            if self.take_mark(open) {
                let mut items = Vec::new();
                while !self.take_mark(close) {
                    items.push(self.value(depth + 1)?);
                    self.take_mark(',');
                }
                return Ok(Value::List(items));
            }
        }
        if self.take_mark('{') {
            return self.entries('}', depth + 1).map(Value::Map);
        }
        let value = match self.peek() {
            Some(Token::Number(number)) => Value::Number(*number),
            Some(Token::Text(text) | Token::Word(text)) => Value::Text(text.clone()),
            _ => return Err(self.error("a value")),
        };
        self.next += 1;
        Ok(value)
    }

    /// Parses metadata (`name = value`), dictionaries (`type name = value`) or time samples (`time: value,`) up to
    /// `close`.
    fn entries(&mut self, close: char, depth: usize) -> Result<Vec<(String, Value)>, ExportError> {
        let mut entries = Vec::new();
        while !self.take_mark(close) {
            let mut key = String::new();
            loop {
                match self.peek() {
                    Some(Token::Word(word) | Token::Text(word)) => key.clone_from(word),
                    Some(Token::Number(number)) => key = number.to_string(),
                    Some(Token::Mark('[' | ']')) => {}
                    Some(Token::Mark('=' | ':' | ',' | ';')) => break,
                    _ if self.peek() == Some(&Token::Mark(close)) => break,
                    _ => return Err(self.error("a name and a value")),
                }
                self.next += 1;
            }
            if self.take_mark('=') || self.take_mark(':') {
                entries.push((key, self.value(depth + 1)?));
            }
            while self.take_mark(',') || self.take_mark(';') {}
        }
        Ok(entries)
    }
}
