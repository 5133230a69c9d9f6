//! A layer of USD as both of its forms hold it: prims with attributes and metadata.

/// Largest nesting depth of prims and values.
pub(super) const MAX_DEPTH: usize = 64;

/// An untyped value.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Number(f64),
    /// A string, a name, a path or an asset.
    Text(String),
    /// A tuple or a list.
    List(Vec<Value>),
    /// A dictionary or time samples, with keys as text.
    Map(Vec<(String, Value)>),
}

impl Value {
    pub(super) fn number(&self) -> Option<f64> {
        if let Self::Number(number) = self { Some(*number) } else { None }
    }

    pub(super) fn numbers(&self) -> Option<Vec<f64>> {
        let Self::List(items) = self else { return self.number().map(|number| vec![number]) };
        let nested: Option<Vec<Vec<f64>>> = items.iter().map(Self::numbers).collect();
        nested.map(|nested| nested.concat())
    }

    pub(super) fn get(&self, name: &str) -> Option<&Self> {
        let Self::Map(entries) = self else { return None };
        entries.iter().find(|(key, _)| key == name).map(|(_, value)| value)
    }
}

/// A prim, or the layer (with an empty kind).
#[derive(Debug, Clone, Default)]
pub(super) struct Prim {
    pub(super) name: String,
    pub(super) kind: String,
    pub(super) metadata: Vec<(String, Value)>,
    /// Values by name; time samples have the name `name.timeSamples`.
    pub(super) attributes: Vec<(String, Value)>,
    pub(super) children: Vec<Prim>,
}

impl Prim {
    pub(super) fn attribute(&self, name: &str) -> Option<&Value> {
        self.attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value)
    }

    pub(super) fn meta(&self, name: &str) -> Option<&Value> {
        self.metadata.iter().find(|(key, _)| key == name).map(|(_, value)| value)
    }
}
