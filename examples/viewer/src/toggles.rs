//! The layers that are shown, and their keys.

use clap::ValueEnum;
use macroquad::input::KeyCode;

/// Something that can be shown or not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Layer {
    /// Bodies filled, or their outlines alone
    Fill,
    /// Boxes of the broad phase
    Boxes,
    /// Columns that the broad phase sorts boxes into
    Columns,
    /// Candidate pairs: lines between bodies whose boxes meet
    Pairs,
    /// Contact points
    Contacts,
    /// Contact normals
    Normals,
    /// Colours by the tier of precision that settled each pair: by its bound, in doubles, exactly
    Tiers,
    /// Darker colours for bodies that sleep
    Sleep,
    /// Hides scenery between the eye and the bodies
    Cut,
    /// Figures and keys
    Text,
}

impl Layer {
    /// Every layer, with its key and its name on the screen.
    pub(crate) const ALL: [(Self, KeyCode, &'static str); 10] = [
        (Self::Fill, KeyCode::Key1, "1 filled"),
        (Self::Boxes, KeyCode::Key2, "2 boxes"),
        (Self::Pairs, KeyCode::Key3, "3 pairs"),
        (Self::Contacts, KeyCode::Key4, "4 contacts"),
        (Self::Normals, KeyCode::Key5, "5 normals"),
        (Self::Tiers, KeyCode::Key6, "6 tiers"),
        (Self::Sleep, KeyCode::Key7, "7 sleep"),
        (Self::Cut, KeyCode::Key8, "8 cut away"),
        (Self::Columns, KeyCode::Key9, "9 columns"),
        (Self::Text, KeyCode::H, "H help"),
    ];
}

/// Which layers are shown.
#[derive(Clone, Debug)]
pub(crate) struct Toggles(Vec<Layer>);

impl Toggles {
    /// What is shown at first, but for these layers.
    pub(crate) fn flipped(layers: &[Layer]) -> Self {
        let mut toggles = Self(vec![Layer::Fill, Layer::Sleep, Layer::Cut, Layer::Text]);
        layers.iter().for_each(|&layer| toggles.flip(layer));
        toggles
    }

    pub(crate) fn shows(&self, layer: Layer) -> bool {
        self.0.contains(&layer)
    }

    pub(crate) fn flip(&mut self, layer: Layer) {
        if self.shows(layer) {
            self.0.retain(|&other| other != layer);
        } else {
            self.0.push(layer);
        }
    }
}
