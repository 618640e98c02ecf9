//! The scene file as parsed JSON: types and field names are right, the content is not checked yet.
//!
//! Vectors are lists of any length here, so that a wrong length is reported with its path in the file.

use core::fmt;
use serde::Deserialize;
use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File {
    #[serde(default)]
    pub(super) name: String,
    pub(super) dimension: u64,
    pub(super) gravity: Vec<f64>,
    #[serde(deserialize_with = "unique_names")]
    pub(super) shapes: Vec<(String, Shape)>,
    pub(super) bodies: Vec<Body>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
pub(super) enum Shape {
    Rect {
        half_extents: Vec<f64>,
        #[serde(default)]
        radius: f64,
    },
    Polygon {
        points: Vec<Vec<f64>>,
        #[serde(default)]
        radius: f64,
    },
    Regular {
        sides: u64,
        radius: f64,
    },
    Circle {
        radius: f64,
    },
    HalfPlane {
        normal: Vec<f64>,
    },
    Outline {
        points: Vec<Vec<f64>>,
    },
    Cuboid {
        half_extents: Vec<f64>,
        #[serde(default)]
        radius: f64,
    },
    Hull {
        points: Vec<Vec<f64>>,
        #[serde(default)]
        radius: f64,
    },
    Prism {
        sides: u64,
        radius: f64,
        half_height: f64,
    },
    Sphere {
        radius: f64,
    },
    HalfSpace {
        normal: Vec<f64>,
    },
    Triangle {
        points: Vec<Vec<f64>>,
    },
    Capsule {
        half_height: f64,
        radius: f64,
    },
    Segment {
        points: Vec<Vec<f64>>,
    },
    Compound {
        parts: Vec<Part>,
    },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Part {
    pub(super) shape: Shape,
    pub(super) position: Vec<f64>,
    pub(super) rotation: Option<Turn>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Body {
    pub(super) shape: String,
    pub(super) position: Vec<f64>,
    pub(super) rotation: Option<Turn>,
    pub(super) linear_velocity: Option<Vec<f64>>,
    pub(super) angular_velocity: Option<Turn>,
    #[serde(default)]
    pub(super) fixed: bool,
    #[serde(default)]
    pub(super) sensor: bool,
    pub(super) layers: Option<Layers>,
    #[serde(default)]
    pub(super) user_data: u64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Layers {
    pub(super) member_of: Vec<u64>,
    pub(super) collides_with: Vec<u64>,
}

/// A number in the plane, a list in space.
pub(super) enum Turn {
    Number(f64),
    List(Vec<f64>),
}

impl<'de> Deserialize<'de> for Turn {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TurnVisitor)
    }
}

// Written by hand, because serde's untagged enums only report that no variant matched, not what was wrong.
struct TurnVisitor;

impl<'de> Visitor<'de> for TurnVisitor {
    type Value = Turn;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number or a list of numbers")
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Turn, E> {
        Ok(Turn::Number(value))
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Turn, E> {
        Ok(Turn::Number(value as f64))
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<Turn, E> {
        Ok(Turn::Number(value as f64))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Turn, A::Error> {
        let mut numbers = Vec::new();
        while let Some(number) = list.next_element()? {
            numbers.push(number);
        }
        Ok(Turn::List(numbers))
    }
}

/// An object's entries in the order of the file. With a map type a later name would silently replace an earlier one.
fn unique_names<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<(String, Shape)>, D::Error> {
    deserializer.deserialize_map(NamesVisitor)
}

struct NamesVisitor;

impl<'de> Visitor<'de> for NamesVisitor {
    type Value = Vec<(String, Shape)>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object with a name for each shape")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut names = std::collections::BTreeSet::new();
        let mut shapes = Vec::new();
        while let Some(name) = map.next_key::<String>()? {
            if !names.insert(name.clone()) {
                return Err(de::Error::custom(format_args!("two shapes are called {name:?}")));
            }
            shapes.push((name, map.next_value()?));
        }
        Ok(shapes)
    }
}
