//! Who reads prompts: the director's networks, or in place of their program a language model.

use cinesplat_director::{Direction, Director, SceneContext, StepCertainty};
use cinesplat_language::{Linked, NamedObject};
use cinesplat_objects::Object;
use cinesplat_reader::{Question, Reader};
use cinesplat_trajectory::ModelRef;

use super::error::PipelineError;

/// The director, and a language model where there is one.
pub struct Interpreter {
    /// Finds the mentions of objects. Without a language model it also gives the program.
    pub director: Director,
    /// Gives the program, the words of its steps and its certainty.
    pub reader: Option<Reader>,
}

impl From<Director> for Interpreter {
    fn from(director: Director) -> Self {
        Self { director, reader: None }
    }
}

impl Interpreter {
    /// Name and hash of the model that gives the program, as shots store them.
    pub fn model_ref(&self) -> ModelRef {
        self.reader.as_ref().map_or_else(|| self.director.model_ref(), Reader::model_ref)
    }

    /// The program that a prompt requests. A language model proposes no cameras.
    pub(super) fn direct(
        &self,
        prompt: &str,
        linked: &Linked,
        scene: &SceneContext<'_>,
    ) -> Result<Direction, PipelineError> {
        let Some(reader) = &self.reader else { return Ok(self.director.direct(linked, scene)?) };
        let understood = reader.read(&question(prompt, linked, scene))?;
        let steps = understood.program.steps.iter().zip(&understood.certainty);
        let certainty = steps.map(|(step, certainty)| StepCertainty {
            probability: certainty.probability,
            weakest: certainty.weakest,
            words: step.words,
            voices: None,
        });
        let certainty = certainty.collect();
        Ok(Direction { program: understood.program, step_cameras: Vec::new(), certainty, unmet: Vec::new() })
    }
}

/// The prompt with the objects that it names, the scene's others, and the things that the scene lacks.
fn question(prompt: &str, linked: &Linked, scene: &SceneContext<'_>) -> Question {
    let named = linked.expanded(&linked.slots);
    let mut objects = names(scene.objects);
    objects.sort_by_key(|object| (!named.contains(&object.id), object.id));
    objects.truncate(cinesplat_reader::MAX_OBJECTS);
    objects.sort_by_key(|object| object.id);
    let missing = linked.missing_groups().map(|group| NamedObject { id: group.id, label: group.name.clone() });
    Question::new(prompt, &objects, &missing.collect::<Vec<_>>())
}

/// Objects by their labels.
pub(super) fn names(objects: &[Object]) -> Vec<NamedObject> {
    objects.iter().map(|object| NamedObject { id: object.id, label: object.label.clone() }).collect()
}
