//! Bodies as plain data: alone, with their shape in full, and in a snapshot, where shapes are shared.

use super::shapes::Saved;
use crate::collider::{Collider, Layers, MarginError};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A body, with a stand-in for its shape. Fields that are missing in a text get a new body's defaults.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename = "Collider", deny_unknown_fields)]
pub(super) struct BodyForm<Shape, Pose> {
    pub(super) shape: Shape,
    #[serde(default)]
    pose: Pose,
    #[serde(default)]
    layers: Layers,
    #[serde(default)]
    owner: Option<u64>,
    #[serde(default)]
    user_data: u64,
    #[serde(default)]
    margin: f32,
    #[serde(default)]
    fixed: bool,
    #[serde(default)]
    sensor: bool,
    #[serde(default)]
    disabled: bool,
    #[serde(default)]
    asleep: bool,
    #[serde(default)]
    bullet: bool,
    #[serde(default)]
    impacts_only: bool,
}

impl<Shape, Pose: Copy> BodyForm<Shape, Pose> {
    pub(super) fn of<S: Saved<Pose = Pose>>(
        body: &Collider<S>,
        shape: impl FnOnce(&S::Shape) -> Shape,
    ) -> Self {
        let Collider {
            shape: of_body,
            pose,
            layers,
            owner,
            user_data,
            margin,
            fixed,
            sensor,
            disabled,
            asleep,
            bullet,
            impacts_only,
        } = body;
        Self {
            shape: shape(of_body),
            pose: *pose,
            layers: *layers,
            owner: *owner,
            user_data: *user_data,
            margin: *margin,
            fixed: *fixed,
            sensor: *sensor,
            disabled: *disabled,
            asleep: *asleep,
            bullet: *bullet,
            impacts_only: *impacts_only,
        }
    }

    /// The body, of this shape. Poses and shapes were checked when they were read.
    pub(super) fn body<S: Saved<Pose = Pose>>(&self, shape: S::Shape) -> Result<Collider<S>, MarginError> {
        let Self {
            shape: _,
            pose,
            layers,
            owner,
            user_data,
            margin,
            fixed,
            sensor,
            disabled,
            asleep,
            bullet,
            impacts_only,
        } = self;
        let is_ground = S::is_ground(&shape);
        Collider::<S> {
            shape,
            pose: *pose,
            layers: *layers,
            owner: *owner,
            user_data: *user_data,
            margin: 0.0,
            fixed: *fixed || is_ground,
            sensor: *sensor,
            disabled: *disabled,
            asleep: *asleep,
            bullet: *bullet,
            impacts_only: *impacts_only,
        }
        .margin(*margin)
    }
}

impl<S: Saved> Serialize for Collider<S> {
    fn serialize<Z: Serializer>(&self, serializer: Z) -> Result<Z::Ok, Z::Error> {
        BodyForm::of(self, S::Shape::clone).serialize(serializer)
    }
}

impl<'de, S: Saved> Deserialize<'de> for Collider<S> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let form = BodyForm::<S::Shape, S::Pose>::deserialize(deserializer)?;
        form.body(form.shape.clone()).map_err(D::Error::custom)
    }
}
