//! An object, and all objects of a scene.

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
    /// Sparse cloud: points on its silhouettes, world.
    pub points: Vec<DVec3>,
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
            points: Vec::new(),
            shape_radius: 0.0,
            mask_iou: 0.0,
        }
    }

    /// Half the diagonal of the box, scene units.
    pub fn radius(&self) -> f64 {
        self.half_extents.length()
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
}
