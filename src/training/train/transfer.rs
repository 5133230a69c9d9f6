//! Initial weights from a model of another vocabulary or of fewer choices.
//!
//! Enters: fresh parameters, and a model of format version 1 or later. Leaves: parameters with the values of the model
//! where they mean the same: tensors of the same name and shape, rows of the same piece of the vocabulary, classes of the
//! same field, the first pointers. The rest stays random.

use std::collections::BTreeMap;

use candle_core::{Tensor, Var};
use cinesplat_director::ModelFiles;
use cinesplat_director::codes::Field;
use cinesplat_director::inputs::Vocabulary;
use strum::VariantArray;

use super::error::TrainError;

/// Fields of format version 1: the first ones of today.
const V1_FIELDS: usize = 17;
/// Classes of [`Field::Via`] in format version 1.
const V1_VIA_CLASSES: usize = 4;

/// A position of a matrix from which a value is taken, per position that gets it.
type Places = Vec<Option<usize>>;

/// Takes over the values of a model. Returns the number of parameters that got a value.
pub(super) fn transfer(
    vars: &BTreeMap<String, Var>,
    files: &ModelFiles,
    vocabulary: &Vocabulary,
) -> Result<usize, TrainError> {
    let stored = files.tensors()?;
    let pieces = piece_rows(vocabulary, &files.vocabulary()?);
    let mut num_taken = 0;
    for (name, var) in vars {
        let Some(tensor) = stored.get(name) else { continue };
        let Some((rows, columns)) = places(name, (tensor, var), &pieces) else { continue };
        num_taken += take(var, tensor, &rows, &columns)?;
    }
    Ok(num_taken)
}

/// For each row and column of `var`, the one of `tensor` whose value it gets; `None` when the two do not correspond.
fn places(name: &str, (tensor, var): (&Tensor, &Var), pieces: &Places) -> Option<(Places, Places)> {
    let (old, new) = (matrix_shape(tensor)?, matrix_shape(var.as_tensor())?);
    let first = |from: usize, to: usize| (0..to).map(|place| Some(place).filter(|place| *place < from)).collect();
    let is_classes = |size: usize| size == v1_classes();
    match name {
        "text.table" | "bert.table" => Some((pieces.iter().take(new[0]).copied().collect(), first(old[1], new[1]))),
        "intent.key.classes.weight" | "pose.key.classes.weight" if is_classes(old[0]) => {
            Some((class_places(), first(old[1], new[1])))
        }
        "head.classes.weight" | "head.classes.bias" if is_classes(old[1]) => {
            Some((first(old[0], new[0]), class_places()))
        }
        "text.kinds"
        | "head.objects.query.weight"
        | "head.objects.query.bias"
        | "head.quantities.query.weight"
        | "head.quantities.query.bias" => Some((first(old[0], new[0]), first(old[1], new[1]))),
        _ if old == new => Some((first(old[0], new[0]), first(old[1], new[1]))),
        _ => None,
    }
}

/// Rows and columns; a vector is one row.
fn matrix_shape(tensor: &Tensor) -> Option<[usize; 2]> {
    match *tensor.dims() {
        [columns] => Some([1, columns]),
        [rows, columns] => Some([rows, columns]),
        _ => None,
    }
}

/// Copies the values, and returns their number.
fn take(var: &Var, tensor: &Tensor, rows: &Places, columns: &Places) -> Result<usize, TrainError> {
    let mut values = var.flatten_all()?.to_vec1::<f32>()?;
    let old = tensor.flatten_all()?.to_vec1::<f32>()?;
    let old_width = tensor.dims().last().copied().unwrap_or(1);
    let mut num_taken = 0;
    for (row, from_row) in rows.iter().enumerate() {
        for (column, from_column) in columns.iter().enumerate() {
            let Some((from_row, from_column)) = from_row.zip(*from_column) else { continue };
            values[row * columns.len() + column] = old[from_row * old_width + from_column];
            num_taken += 1;
        }
    }
    var.set(&Tensor::from_vec(values, var.shape(), var.device())?)?;
    Ok(num_taken)
}

/// Per token of `vocabulary`, the token of `old` with the same text.
fn piece_rows(vocabulary: &Vocabulary, old: &Vocabulary) -> Places {
    let old = old.pieces();
    let mut rows = vec![None; vocabulary.size()];
    for (piece, id) in vocabulary.pieces() {
        if let Some(row) = rows.get_mut(id as usize) {
            *row = old.get(&piece).map(|id| *id as usize);
        }
    }
    rows
}

fn v1_num_classes(field: Field) -> usize {
    if field == Field::Via { V1_VIA_CLASSES } else { field.num_classes() }
}

fn v1_classes() -> usize {
    Field::VARIANTS.iter().take(V1_FIELDS).map(|field| v1_num_classes(*field)).sum()
}

/// Per class of today, the class of format version 1 with the same meaning.
fn class_places() -> Places {
    let mut places = vec![None; Field::total_classes()];
    let mut old = 0;
    for field in Field::VARIANTS.iter().take(V1_FIELDS).copied() {
        for class in 0..v1_num_classes(field) {
            places[field.offset() + class] = Some(old);
            old += 1;
        }
    }
    places
}
