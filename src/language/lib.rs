//! The words of a prompt: its objects and quantities, the effects it mentions, and the text notation of programs.
//!
//! Enters: a prompt and the scene's named objects. Leaves ([`link`]): the prompt as plain words in which placeholders
//! stand for objects and quantities, each word with its bytes of the prompt. The one invariant: spans lie on character
//! boundaries of the prompt. What a prompt means is the director's to decide; idioms
//! are only said in other words.
//!
//! Before anything else shorthand becomes plain words (`Z/I 24-70` = `zoom in 24 to 70`; `prompts/shorthand.txt`), and
//! misspelled words of command are mended ([`plain_words`]). After it idioms become the words of the trade (`let the
//! mug slide past from right to left` = `truck right past the mug`; `prompts/idioms.txt`). A prompt that says part by
//! part what happens when is a [`Timeline`], and the director reads it part by part. Heights that people name (`at knee height`;
//! `prompts/heights.txt`) and parts of things (`the sole`; `prompts/parts.txt`) are told by [`Linked::spoken_heights`] and
//! [`part_of`].
//!
//! # Notation of programs
//!
//! A [`Program`](cinesplat_operator::Program) has a short text form, used by training data, the exam and tests:
//!
//! ```text
//! push-in end=3:close-up dur=2s / orbit-left end=3 amount=45deg | total=8s
//! ```
//!
//! Its grammar (EBNF; tokens are separated by spaces and may stand in any order):
//!
//! ```text
//! program   = ( step { " / " step } | "none" ) [ "|" { film } ] ;
//! film      = "total=" number "s" | "no=" MOTION { "+" MOTION } | limit ;
//! limit     = ( "above=" | "below=" ) ( number "u" | object )   (* height of the camera, or of a thing that bounds it *)
//!           | "clear=" [ object ":" ] number "u"    (* least distance to the object, or to anything *)
//!           | "within=" object ":" number "u"       (* largest distance to the object *)
//!           | "speed=" number ( "u" | "deg" ) ;     (* largest speed, a second *)
//! step      = move { token } ;
//! move      = MOVE | family ;                       (* push-in | pan *)
//! token     = direction | framing | pass | look | view | amount | duration | speed
//!           | easing | further | flag ;
//! direction = "left" | "right" | "up" | "down" | "in" | "out" | "cw" | "ccw" ;
//! framing   = side "=" subjects { qualifier }       (* names the subjects *)
//!           | side qualifier { qualifier } ;        (* adds to a framing *)
//! side      = "start" | "end" ;
//! subjects  = "room" | object { "+" object } ;
//! qualifier = ":" ( SIZE | ANGLE | PART | SIDE | PLACE | lens | measure | "hidden" | "before-" object ) | "!" | "+" object ;
//!                                                   (* before-7: object 7 is seen behind the subject *)
//! lens      = number "mm" | number "fov" | "wide-lens" | "long-lens" ;
//! measure   = number "%"                            (* height of the subject over that of the frame *)
//!           | number "deg"                          (* elevation from which the subject is seen *)
//!           | "h" number "u"                        (* height of the camera above the floor *)
//!           | "d" number "u" ;                      (* distance to the subject *)
//! pass      = PASS "=" object { "+" object } ;
//! look      = "look=" ( object { "+" object } | "ahead" | "back" | "room" ) ;
//! view      = ( "keep" | "avoid" ) "=" object { "+" object } ;
//! amount    = "amount=" ( number ( "deg" | "u" | "x" ) | "slight" | "large" ) ;
//! duration  = "dur=" number "s" ;
//! speed     = "slow" | "fast" ;
//! easing    = "ease=" EASING ;
//! further   = "with=" move [ "+" move ] ;
//! flag      = "cut" | "returns" | "either" ;
//! object    = integer ;                             (* id of an object *)
//! ```
//!
//! `MOVE`, `SIZE`, `ANGLE` and `EASING` are the names of [`Move`](cinesplat_trajectory::Move),
//! [`ShotSize`](cinesplat_trajectory::ShotSize), [`ShotAngle`](cinesplat_trajectory::ShotAngle) and
//! [`Easing`](cinesplat_trajectory::Easing); `PART`, `SIDE`, `PLACE`, `PASS` and `MOTION` those of
//! [`SubjectPart`](cinesplat_operator::SubjectPart), [`SubjectSide`](cinesplat_operator::SubjectSide),
//! [`FramePlace`](cinesplat_operator::FramePlace), [`Pass`](cinesplat_operator::Pass) and
//! [`Motion`](cinesplat_operator::Motion). What each means in geometry is in their docs and in those of
//! [`Step`](cinesplat_operator::Step) and [`Framing`](cinesplat_operator::Framing). A `family` is the name of a move
//! that exists in two directions, without the direction: `pan`, `tilt`, `roll`, `truck`, `pedestal`, `crane`, `orbit`,
//! `arc`, `zoom`, `dolly-zoom`. A family takes its direction from the step. Without one it gets `right`, `up`, `in` or
//! `cw` and the step is `either`: both directions are right. `room` means no subject, `!` all subjects wholly in the
//! frame. `none` is a program without steps: nothing that a camera could do. Amounts are degrees (`deg`), scene units
//! (`u`) or a factor on the distance or focal length (`x`). The flags `cut` and `returns` mean that the step begins
//! with a cut, or ends where the shot began.
//!
//! ```
//! use cinesplat_language::{program_from_notation, program_to_notation};
//! use cinesplat_trajectory::Move;
//!
//! let program = program_from_notation("orbit left end=3:low! amount=45deg slow | total=8s")?;
//! assert_eq!(program.steps[0].movement, Move::OrbitLeft);
//! assert_eq!(program.steps[0].end.subjects, [3]);
//! assert_eq!(program.duration_secs, Some(8.0));
//! assert_eq!(program_to_notation(&program), "orbit-left end=3:low! amount=45deg slow | total=8s");
//! # Ok::<(), cinesplat_language::NotationError>(())
//! ```
//!
//! What [`program_to_notation`] prints is also a [`Pattern`] ([`program_pattern`]). Its [`Automaton`] holds a writer to
//! the notation byte by byte: whatever it lets pass parses.

mod backdrops;
mod blanks;
mod borne;
mod camera_words;
mod chain;
mod corrections;
mod dictation;
mod edit_distance;
mod effects;
mod error;
#[cfg(test)]
mod fixture;
mod forbidding;
mod frame_rate;
mod frame_shape;
mod heights;
mod idioms;
mod inflection;
mod known_words;
mod lexicon;
mod limits;
mod link;
mod linked;
mod list_lines;
mod mention;
mod names;
mod not_things;
mod notation;
mod numbered;
mod numerals;
mod part;
mod pictograms;
mod plain;
mod quantity;
mod rates;
mod scenery;
mod senses;
mod slates;
mod thing_parts;
mod things;
mod timeline;
mod tokenizer;
mod tolerances;
mod turned_ways;
mod unknown;

pub use backdrops::without_behind;
pub use blanks::blanked;
pub use chain::without_arrows;
pub use dictation::without_dictation;
pub use edit_distance::edit_distance;
pub use effects::{DUTCH_ANGLE, EffectMention, are_effect_phrases, effect_mentions, without_camera_settings};
pub use error::LanguageError;
pub use forbidding::forbidding_words;
pub use frame_rate::{FrameRate, frame_rate};
pub use frame_shape::{FrameShape, frame_shape, without_frame_shape};
pub use heights::SpokenHeight;
pub use inflection::{VerbForm, inflect, stem};
pub use known_words::GRAMMAR_TEXT;
pub use lexicon::{Lexicon, WordList};
pub use link::link;
pub use linked::{Backdrop, Group, Linked, MAX_PROMPT_BYTES, MAX_QUANTITIES, MAX_SLOTS, add_ids};
pub use mention::{Mention, check_prompt, link_mentions, link_parts};
pub use names::{NamedObject, nearest_names};
pub use not_things::is_no_thing;
pub use notation::{
    Automaton, MAX_LISTED, MAX_STEPS, NotationError, Pattern, States, program_from_notation, program_pattern,
    program_to_notation, step_from_notation,
};
pub use numbered::{NumberedMention, numbered_mention_at};
pub use numerals::number_word;
pub use plain::{is_foreign, mend_names, plain_words};
pub use quantity::{Quantity, QuantityKind};
pub use rates::Rate;
pub use scenery::scenery;
pub use senses::{Senses, sense_names};
pub use slates::{without_references, without_slate};
pub use thing_parts::{PartPlace, SaidPart, own_part_at, part_of, said_parts};
pub use things::{Kind, MAX_PHRASE_WORDS, Relation, Things};
pub use timeline::{Beat, BeatLength, Timeline};
pub use tokenizer::{Word, is_listed, tokenize};
pub use tolerances::without_tolerances;
pub use unknown::UnknownName;
