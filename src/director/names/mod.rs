//! Names: which words of a prompt name which objects of the scene, by a small network.
//!
//! Enters: a prompt and the scene's named objects. Leaves: [`FoundMention`]s, which
//! [`link_mentions`](cinesplat_language::link_mentions) turns into placeholders. A tagger reads the words (hashed n-grams,
//! and what each word has to do with each label: equal, misspelled, a synonym, a broader kind or a part by
//! `prompts/things.txt`) and finds the mentions. A pointer then decides for each mention and object whether it is meant,
//! and for each mention whether it is a thing that the scene lacks.
//! The one invariant: mentions do not overlap, stand in order, and a mention by number (`<obj-3>`) is the object of that
//! number.

mod batch;
mod decode;
mod files;
mod mention_input;
mod network;
mod ngrams;
mod scene;
mod sentence;
mod words;

pub use batch::{MentionBatch, SentenceBatch};
pub use decode::{DecodedMention, decode};
pub use files::NamesFiles;
pub use mention_input::MentionInput;
pub use network::{MentionScores, NUM_TAGS, NamesConfig, NamesNetwork, WordStates};
pub use scene::{Label, SceneNames, SceneObject};
pub use sentence::Sentence;
pub use words::{NameWord, name_words};

use std::collections::BTreeSet;
use std::path::Path;

use cinesplat_language::{Mention, NamedObject, mend_names, nearest_names, plain_words, tokenize};

use crate::error::DirectorError;

/// A mention that the network has found.
#[derive(Debug, Clone, PartialEq)]
pub struct FoundMention {
    /// Its bytes and ids; no ids for a thing that the scene lacks.
    pub mention: Mention,
    /// Probability, 0..=1.
    pub probability: f64,
    /// The scene's nearest names for a thing that it lacks, best first: `<obj-3> golden skull`.
    pub nearest: Vec<String>,
}

/// The trained network of names.
#[derive(Debug, Clone)]
pub struct Names {
    network: NamesNetwork,
}

impl Names {
    /// The network with the weights that are compiled into the program.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when the built-in files do not fit together.
    pub fn embedded() -> Result<Self, DirectorError> {
        Self::from_files(&NamesFiles::embedded())
    }

    /// A network from the files of a folder; `path` is the folder, or any file in it.
    ///
    /// # Errors
    /// [`DirectorError::Read`] · [`DirectorError::BadModel`] when a file is damaged, of another version, or does not fit
    /// the other.
    pub fn load(path: &Path) -> Result<Self, DirectorError> {
        Self::from_files(&NamesFiles::read(path)?)
    }

    /// A network from files in memory.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when a file is damaged, of another version, or does not fit the other.
    pub fn from_files(files: &NamesFiles) -> Result<Self, DirectorError> {
        Ok(Self { network: files.network()? })
    }

    /// The mentions of a prompt, in order. A prompt longer than 400 words is read up to there.
    ///
    /// # Errors
    /// [`DirectorError::Language`] when the embedded lexicon is malformed · [`DirectorError::NotFinite`] when the weights are
    /// damaged · [`DirectorError::Compute`] when a tensor operation fails.
    pub fn mentions(&self, prompt: &str, objects: &[NamedObject]) -> Result<Vec<FoundMention>, DirectorError> {
        let labels: BTreeSet<String> =
            objects.iter().flat_map(|object| tokenize(&object.label)).map(|word| word.stem).collect();
        let mut words = plain_words(prompt, &tokenize(prompt), &|word| labels.contains(&word.stem))?;
        mend_names(&mut words, &labels)?;
        let sentence = Sentence::about(name_words(&words), objects)?;
        let mut found = Vec::new();
        for decoded in decode(&self.network, &sentence)? {
            let first = sentence.words[decoded.words.start].bytes[0];
            let bytes = [first, sentence.words[decoded.words.end - 1].bytes[1]];
            let ids: Vec<u32> = decoded.objects.iter().map(|at| sentence.scene.objects[*at].id).collect();
            let nearest = match ids[..] {
                [] => nearest_names(prompt.get(bytes[0]..bytes[1]).unwrap_or_default(), objects)?,
                _ => Vec::new(),
            };
            found.push(FoundMention { mention: Mention { bytes, ids }, probability: decoded.probability, nearest });
        }
        Ok(found)
    }
}
