//! The look of methods: one colour for each, in all plots. The colours are those of Okabe and Ito, which are distinct
//! for every kind of colour vision; marks distinguish families where colours do not.

use plotters::style::RGBColor;

/// The mark for a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Ours.
    Disc,
    /// The peer's.
    Square,
    /// The textbook's.
    Triangle,
}

/// How one method is drawn and named.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// Its name, next to a point or a line.
    pub name: String,
    /// Its colour.
    pub color: RGBColor,
    /// Its mark.
    pub mark: Mark,
}

/// The colour of text.
pub const INK: RGBColor = RGBColor(26, 26, 26);
/// The colour of secondary text.
pub const PALE: RGBColor = RGBColor(90, 90, 90);
/// The colour of grid lines.
pub const GRID: RGBColor = RGBColor(224, 224, 224);
/// The colour of our main method.
pub const OURS: RGBColor = RGBColor(0, 114, 178);
/// The colour of the peer.
pub const PEER: RGBColor = RGBColor(213, 94, 0);
/// Colours of the stages of a frame, in order, and of the rest of it: shades of one hue that no method has.
pub const STAGES: [RGBColor; 6] = [
    RGBColor(198, 219, 239),
    RGBColor(107, 174, 214),
    RGBColor(8, 81, 156),
    RGBColor(158, 154, 200),
    RGBColor(84, 39, 143),
    RGBColor(204, 204, 204),
];

/// The look of a method, by its name in the data. An unknown method is grey, and has its own name.
///
/// ```
/// use asunder_benches::report::palette::{OURS, look};
/// assert_eq!((look("certain").color, look("asunder").color), (OURS, OURS));
/// assert_eq!(look("somebody").name, "somebody");
/// ```
pub fn look(method: &str) -> Look {
    let (name, color, mark) = match method {
        "certain" => ("asunder", OURS, Mark::Disc),
        "asunder" => ("asunder", OURS, Mark::Disc),
        "fast" => ("asunder guess", RGBColor(86, 180, 233), Mark::Disc),
        "batched-boxes" => ("asunder 8 boxes", RGBColor(0, 158, 115), Mark::Disc),
        "parry-f32" | "parry3d" => ("parry3d", PEER, Mark::Square),
        "parry-f64" => ("parry3d f64", RGBColor(230, 159, 0), Mark::Square),
        "textbook-f32" => ("textbook f32", RGBColor(204, 121, 167), Mark::Triangle),
        "textbook-f64" => ("textbook f64", RGBColor(130, 60, 110), Mark::Triangle),
        "memory" => ("memory", PALE, Mark::Triangle),
        other => (other, PALE, Mark::Triangle),
    };
    Look { name: name.to_string(), color, mark }
}

/// Whether a method is ours.
///
/// ```
/// use asunder_benches::report::palette::is_ours;
/// assert!(is_ours("fast") && is_ours("asunder") && !is_ours("parry-f64"));
/// ```
pub fn is_ours(method: &str) -> bool {
    ["certain", "asunder", "fast", "batched-boxes"].contains(&method)
}

/// The rank of a method in lists: ours first, then the textbook's, then the peer's; unknown ones last.
pub fn rank(method: &str) -> usize {
    const ORDER: [&str; 10] = [
        "asunder",
        "certain",
        "fast",
        "batched-boxes",
        "textbook-f64",
        "textbook-f32",
        "parry-f64",
        "parry-f32",
        "parry3d",
        "memory",
    ];
    ORDER.iter().position(|&known| known == method).unwrap_or(ORDER.len())
}
