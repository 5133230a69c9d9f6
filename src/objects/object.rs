//! An object, and all objects of a scene.

use std::borrow::Cow;
use std::collections::BTreeMap;

use glam::{DQuat, DVec3};

/// One object of a scene: a box, a name, and a sparse cloud of its shape.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    /// Identity, 1..=65535; `<obj-N>` in a prompt.
    pub id: u32,
    /// Name, such as `microwave`; empty where unknown. A prompt may refer to the object by it.
    pub label: String,
    /// Box center, world.
    pub center: DVec3,
    /// Half of the box's extent along its own axes, scene units.
    pub half_extents: DVec3,
    /// Rotation from the box axes to the world.
    pub rotation: DQuat,
    /// Number of Gaussians that belong to it; 0 where only the box is known.
    pub num_gaussians: usize,
    /// Id of the object that it is a part of.
    pub parent: Option<u32>,
    /// Sparse cloud: points on its silhouettes, world.
    pub points: Vec<DVec3>,
    /// Features of the points; empty unless they were asked for.
    pub features: PointFeatures,
    /// Radius of the alpha shapes of the cloud, scene units; 0 without a cloud.
    pub shape_radius: f64,
    /// Mean overlap (intersection over union) of the alpha shapes and the rendered masks, 0..=1; 0 without a cloud.
    pub mask_iou: f64,
}

impl Object {
    /// An object of which only the box is known, along the axes of the world.
    pub fn from_box(id: u32, label: &str, center: DVec3, half_extents: DVec3) -> Self {
        Self {
            id,
            label: label.to_owned(),
            center,
            half_extents,
            rotation: DQuat::IDENTITY,
            num_gaussians: 0,
            parent: None,
            points: Vec::new(),
            features: PointFeatures::default(),
            shape_radius: 0.0,
            mask_iou: 0.0,
        }
    }

    /// Half the diagonal of the box, scene units.
    pub fn radius(&self) -> f64 {
        self.half_extents.length()
    }

    /// Half extents along the axes of the box, world.
    pub fn half_axes(&self) -> [DVec3; 3] {
        [DVec3::X, DVec3::Y, DVec3::Z].map(|own| self.rotation * (own * self.half_extents))
    }

    /// Least and largest coordinate of the box along an axis of length 1, scene units.
    pub fn span_along(&self, axis: DVec3) -> [f64; 2] {
        let reach: f64 = self.half_axes().iter().map(|own| own.dot(axis).abs()).sum();
        let middle = self.center.dot(axis);
        [middle - reach, middle + reach]
    }

    /// The eight corners of the box, world.
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            let sign = |bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
            self.center + self.rotation * (self.half_extents * DVec3::new(sign(0), sign(1), sign(2)))
        })
    }

    /// Whether a world point lies in the box extended by `margin` (scene units) on every side.
    pub fn contains(&self, point: DVec3, margin: f64) -> bool {
        let local = self.rotation.conjugate() * (point - self.center);
        local.abs().cmple(self.half_extents + margin).all()
    }

    /// Which Gaussians are the object's, by index and center (world): those with its label where `labels` has any, or else
    /// those in its box extended by `margin` (scene units).
    pub fn owns<'a>(&'a self, labels: &'a [u16], margin: f64) -> impl Fn(usize, DVec3) -> bool + 'a {
        let is_own = |label: &u16| u32::from(*label) == self.id;
        let is_labelled = labels.iter().any(is_own);
        move |i, center| {
            if is_labelled { labels.get(i).is_some_and(is_own) } else { self.contains(center, margin) }
        }
    }
}

/// What a network for pictures tells about the points of a cloud.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PointFeatures {
    /// Numbers per point; 0 where there are none.
    pub num_channels: usize,
    /// `[point * num_channels + channel]`, in the order of the object's points. A point that no picture shows has zeros.
    pub values: Vec<f32>,
}

/// All objects of a scene, and the object of every Gaussian.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ObjectSet {
    /// The objects, in order of id.
    pub objects: Vec<Object>,
    /// One object id per Gaussian in file order, 0 for none; empty where only boxes are known.
    pub labels: Vec<u16>,
}

impl ObjectSet {
    /// The object with an id; `None` where there is none.
    pub fn get(&self, id: u32) -> Option<&Object> {
        self.objects.iter().find(|object| object.id == id)
    }

    /// The labels with the id of an object in place of those of its parts: its Gaussians and theirs.
    pub fn labels_of(&self, id: u32) -> Cow<'_, [u16]> {
        let parts = self.parts_of(id);
        if parts.is_empty() {
            return Cow::Borrowed(&self.labels);
        }
        let merged = |label: &u16| if parts.contains(&u32::from(*label)) { id as u16 } else { *label };
        Cow::Owned(self.labels.iter().map(merged).collect())
    }

    /// Indices of the Gaussians of every object, those of its parts included, ascending.
    pub(crate) fn members(&self) -> BTreeMap<u32, Vec<usize>> {
        let mut members: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        let parents: BTreeMap<u32, u32> =
            self.objects.iter().filter_map(|object| Some((object.id, object.parent?))).collect();
        for (i, &label) in self.labels.iter().enumerate().filter(|(_, label)| **label > 0) {
            let mut id = Some(u32::from(label));
            // No object is a part of itself, which bounds the number of steps.
            for _ in 0..=parents.len() {
                let Some(whole) = id else { break };
                members.entry(whole).or_default().push(i);
                id = parents.get(&whole).copied();
            }
        }
        members
    }

    /// Every object with the number of wholes that it is a part of, one inside the other; each whole is followed by its
    /// parts.
    pub fn with_parts(&self) -> Vec<(&Object, usize)> {
        let parts_of = |whole: Option<u32>, depth: usize| {
            let parts = self.objects.iter().rev().filter(move |object| object.parent == whole);
            parts.map(move |object| (object, depth))
        };
        let mut open: Vec<(&Object, usize)> = parts_of(None, 0).collect();
        let mut ordered = Vec::with_capacity(self.objects.len());
        while let Some((object, depth)) = open.pop() {
            ordered.push((object, depth));
            open.extend(parts_of(Some(object.id), depth + 1));
        }
        ordered
    }

    /// Ids of all parts of an object, and of their parts.
    pub fn parts_of(&self, id: u32) -> Vec<u32> {
        let mut parts = vec![id];
        let mut at = 0;
        while let Some(&whole) = parts.get(at) {
            let is_new = |object: &&Object| object.parent == Some(whole) && !parts.contains(&object.id);
            let found: Vec<u32> = self.objects.iter().filter(is_new).map(|object| object.id).collect();
            parts.extend(found);
            at += 1;
        }
        parts.split_off(1)
    }
}
