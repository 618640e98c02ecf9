//! Scene files that are right, and many that are wrong: each error names the place of the fault, and none panics.

use super::*;

const PLANE: &str = r#"{
  "dimension": 2,
  "gravity": [0, -9.81],
  "shapes": {
    "box": { "rect": { "half_extents": [1, 0.5] } },
    "ramp": { "polygon": { "points": [[0, 0], [4, 0], [4, 2]] } },
    "ball": { "regular": { "sides": 16, "radius": 0.5 } }
  },
  "bodies": [
    { "shape": "box", "position": [0, 0], "fixed": true },
    { "shape": "ramp", "position": [3, 0], "rotation": 0.25 },
    { "shape": "ball", "position": [0, 9], "linear_velocity": [2, 0], "angular_velocity": -3,
      "sensor": true, "layers": { "member_of": [0, 5], "collides_with": [31] }, "user_data": 18446744073709551615 }
  ]
}"#;

const VOLUME: &str = r#"{
  "name": "yard",
  "dimension": 3,
  "gravity": [0, -9.81, 0],
  "shapes": {
    "crate": { "cuboid": { "half_extents": [1, 1, 1] } },
    "rock": { "hull": { "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]] } },
    "barrel": { "prism": { "sides": 12, "radius": 0.5, "half_height": 0.75 } }
  },
  "bodies": [
    { "shape": "crate", "position": [1, 2, 3], "rotation": [0, 0, 3, 3] },
    { "shape": "rock", "position": [0, 5, 0], "angular_velocity": [0, 1, 0] },
    { "shape": "barrel", "position": [0, 8, 0], "linear_velocity": [0, -4, 0] }
  ]
}"#;

fn message(json: &str) -> String {
    match Level::from_json(json) {
        Ok(_) => panic!("accepted: {json}"),
        Err(error) => error.to_string(),
    }
}

/// The message for a file in which one piece of text is replaced.
fn refused(json: &str, from: &str, to: &str) -> String {
    assert!(json.contains(from), "{from}");
    message(&json.replacen(from, to, 1))
}

#[test]
fn reads_a_level_in_the_plane() {
    let Level::Plane(level) = Level::from_json(PLANE).unwrap() else { panic!("it is in the plane") };
    assert_eq!(level.name, "");
    assert_eq!(level.gravity, DVec2::new(0.0, -9.81));
    let [floor, ramp, ball] = &level.bodies[..] else { panic!("three bodies") };
    assert!(floor.fixed && !ramp.fixed && ball.sensor && !ramp.sensor);
    assert_eq!(ramp.pose.position(), DVec2::new(3.0, 0.0));
    assert!((f64::from(ramp.pose.rotation().sin()) - libm::sin(0.25)).abs() < 1e-7);
    assert_eq!((ball.linear_velocity, ball.angular_velocity), (DVec2::new(2.0, 0.0), -3.0));
    assert_eq!(ball.layers, Some(LevelLayers { member_of: 0b10_0001, collides_with: 1 << 31 }));
    assert_eq!((ramp.layers, ball.user_data), (None, u64::MAX));
    let Shape2::Polygon(outline) = &ball.shape else { panic!("a regular polygon is a polygon") };
    assert_eq!(outline.vertices().len(), 16);
}

#[test]
fn reads_a_level_in_space() {
    let Level::Volume(level) = Level::from_json(VOLUME).unwrap() else { panic!("it is in space") };
    assert_eq!((level.name.as_str(), level.bodies.len()), ("yard", 3));
    assert_eq!(level.bodies[0].pose.rotation().to_array(), [0.0, 0.0, 3.0, 3.0], "kept bit for bit");
    assert_eq!(level.bodies[1].angular_velocity, DVec3::Y);
    let Shape3::Hull(barrel) = &level.bodies[2].shape else { panic!("a prism is a hull") };
    assert_eq!((barrel.vertices().len(), barrel.topology().face_count()), (24, 14));
}

/// A level with one body of a shape, and nothing else.
fn one_shape(dimension: usize, shape: &str) -> String {
    let zeros = vec!["0"; dimension].join(", ");
    format!(
        r#"{{ "dimension": {dimension}, "gravity": [{zeros}], "shapes": {{ "it": {shape} }},
              "bodies": [{{ "shape": "it", "position": [{zeros}] }}] }}"#
    )
}

#[test]
fn reads_every_kind_of_shape_and_refuses_it_in_the_other_dimension() {
    let plane = [
        (r#"{"rect": {"half_extents": [1, 2], "radius": 0.25}}"#, 0.25),
        (r#"{"polygon": {"points": [[0, 0], [1, 0], [0, 1]], "radius": 0.5}}"#, 0.5),
        (r#"{"circle": {"radius": 2}}"#, 2.0),
        (r#"{"capsule": {"half_height": 1, "radius": 0.5}}"#, 0.5),
        (r#"{"segment": {"points": [[0, 0], [1, 0]]}}"#, 0.0),
        (r#"{"half_plane": {"normal": [0, 3]}}"#, 0.0),
        (r#"{"outline": {"points": [[0, 0], [4, 0], [1, 1], [0, 4]]}}"#, 0.0),
        (
            r#"{"compound": {"parts": [{"shape": {"circle": {"radius": 1}}, "position": [1, 0], "rotation": 1}]}}"#,
            0.0,
        ),
    ];
    for (shape, radius) in plane {
        let Level::Plane(level) = Level::from_json(one_shape(2, shape)).unwrap() else { panic!("{shape}") };
        assert_eq!(level.bodies[0].shape.radius(), radius, "{shape}");
    }
    let space = [
        (r#"{"cuboid": {"half_extents": [1, 2, 3], "radius": 0.25}}"#, 0.25),
        (r#"{"hull": {"points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "radius": 0.5}}"#, 0.5),
        (r#"{"sphere": {"radius": 2}}"#, 2.0),
        (r#"{"capsule": {"half_height": 1, "radius": 0.5}}"#, 0.5),
        (r#"{"segment": {"points": [[0, 0, 0], [1, 0, 0]]}}"#, 0.0),
        (r#"{"triangle": {"points": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}}"#, 0.0),
        (r#"{"half_space": {"normal": [0, 3, 0]}}"#, 0.0),
        (r#"{"compound": {"parts": [{"shape": {"sphere": {"radius": 1}}, "position": [1, 0, 0]}]}}"#, 0.0),
    ];
    for (shape, radius) in space {
        let Level::Volume(level) = Level::from_json(one_shape(3, shape)).unwrap() else { panic!("{shape}") };
        assert_eq!(level.bodies[0].shape.radius(), radius, "{shape}");
        let kind = shape.split('"').nth(1).unwrap();
        if !["capsule", "segment", "compound"].contains(&kind) {
            let expected = format!("shapes[\"it\"].{kind}: a {kind} is a shape of dimension 3");
            assert!(
                message(&one_shape(2, shape)).starts_with(&expected),
                "{}",
                message(&one_shape(2, shape))
            );
        }
    }
}

#[test]
fn faults_of_shapes_name_their_place() {
    let cases = [
        (2, r#"{"circle": {"radius": 0}}"#, "circle: radius 0 m is below"),
        (2, r#"{"circle": {"radius": 1e99}}"#, "circle: 1e99 is more than an f32 can hold"),
        (3, r#"{"capsule": {"half_height": 0, "radius": 1}}"#, "capsule: both ends are the same point"),
        (
            3,
            r#"{"cuboid": {"half_extents": [1, 1, 1], "radius": -1}}"#,
            "cuboid.radius: radius -1 m is negative",
        ),
        (3, r#"{"triangle": {"points": [[0, 0, 0], [1, 0, 0]]}}"#, "triangle.points: 3 points belong here"),
        (
            3,
            r#"{"triangle": {"points": [[0, 0, 0], [1, 0, 0], [2, 0, 0]]}}"#,
            "triangle: the vertices lie on one line",
        ),
        (3, r#"{"half_space": {"normal": [0, 0, 0]}}"#, "half_space.normal: the direction is zero"),
        (3, r#"{"compound": {"parts": []}}"#, "compound: a compound needs a part"),
        (2, r#"{"outline": {"points": [[0, 0], [2, 2], [2, 0], [0, 2]]}}"#, "outline: "),
        (
            3,
            r#"{"compound": {"parts": [{"shape": {"sphere": {"radius": -1}}, "position": [0, 0, 0]}]}}"#,
            "compound.parts[0].shape.sphere: radius -1 m is negative",
        ),
        (
            2,
            r#"{"compound": {"parts": [{"shape": {"circle": {"radius": 1}}, "position": [0]}]}}"#,
            "compound.parts[0].position: 2 numbers belong here",
        ),
    ];
    for (dimension, shape, expected) in cases {
        let message = message(&one_shape(dimension, shape));
        assert!(message.starts_with(&format!("shapes[\"it\"].{expected}")), "{shape}: {message}");
    }
}

#[test]
fn text_that_is_no_scene_gets_line_and_column() {
    assert_eq!(message(""), "EOF while parsing a value at line 1 column 0");
    assert_eq!(
        refused(PLANE, "\"fixed\": true", "\"fixd\": true"),
        "unknown field `fixd`, expected one of `shape`, `position`, `rotation`, `linear_velocity`, \
         `angular_velocity`, `fixed`, `sensor`, `layers`, `user_data` at line 10 column 48"
    );
    let by_place = [
        ("[0, -9.81]", "[0, NaN]", "line 3"),
        ("[0, -9.81]", "[0, 1e999]", "line 3"),
        ("[0, -9.81]", "\"down\"", "line 3"),
        ("[0, -9.81]", "[0, null]", "line 3"),
        ("\"dimension\": 2", "\"dimension\": 2.5", "line 2"),
        ("\"dimension\": 2", "\"dimension\": -2", "line 2"),
        ("\"gravity\"", "\"dimension\": 2, \"gravity\"", "line 3"),
        ("\"ball\":", "\"box\":", "two shapes are called \"box\" at line 7"),
        ("\"rect\":", "\"circle\":", "line 5"),
        ("\"half_extents\": [1, 0.5]", "\"half_extents\": [1, 0.5], \"round\": 1", "line 5"),
        ("\"sides\": 16", "\"sides\": 16.5", "line 7"),
        ("\"shape\": \"box\",", "", "missing field `shape` at line 10"),
        ("\"rotation\": 0.25", "\"rotation\": \"left\"", "a number or a list of numbers at line 11"),
        ("\"rotation\": 0.25", "\"rotation\": [1, \"x\"]", "line 11"),
        ("\"collides_with\"", "\"collides\"", "line 13"),
        ("18446744073709551615", "18446744073709551616", "line 13"),
        ("18446744073709551615", "-1", "line 13"),
    ];
    for (from, to, place) in by_place {
        let message = refused(PLANE, from, to);
        assert!(message.contains(place) && message.contains(" column "), "{to}: {message}");
    }
}

#[test]
fn content_faults_name_their_path_in_the_plane() {
    let by_path = [
        ("\"dimension\": 2", "\"dimension\": 4", "dimension: there is no dimension 4: give 2 or 3"),
        ("[0, -9.81]", "[0, -9.81, 0]", "gravity: 2 numbers belong here, and there are 3"),
        (
            "[0, -9.81]",
            "[0, 1e300]",
            "gravity: its length, inf, is more than the 1000 that a scene may ask for",
        ),
        (
            "[1, 0.5]",
            "[1, -0.5]",
            "shapes[\"box\"].rect.half_extents: half extent -0.5 on axis 1 is not positive: give half of the full size",
        ),
        ("[1, 0.5]", "[1, 1e39]", "shapes[\"box\"].rect.half_extents: 1e39 is more than an f32 can hold"),
        ("[4, 2]", "[4, -2]", "shapes[\"ramp\"].polygon: the vertices wind clockwise: reverse their order"),
        ("[4, 2]", "[4]", "shapes[\"ramp\"].polygon.points[2]: 2 numbers belong here, and there are 1"),
        (
            "[4, 2]",
            "[4, 0]",
            "shapes[\"ramp\"].polygon: points 1 and 2 are the same: leave one out, or use Polygon::hull_of",
        ),
        (
            "\"sides\": 16",
            "\"sides\": 2",
            "shapes[\"ball\"].regular.sides: 2 sides are not possible: give 3 to 4096",
        ),
        (
            "\"sides\": 16",
            "\"sides\": 4000000000",
            "shapes[\"ball\"].regular.sides: 4000000000 sides are not possible: give 3 to 4096",
        ),
        (
            "\"radius\": 0.5",
            "\"radius\": 0",
            "shapes[\"ball\"].regular.radius: 0 is not positive: give a length in metres",
        ),
        (
            "\"shape\": \"ramp\"",
            "\"shape\": \"ra\\nmp\"",
            "bodies[1].shape: there is no shape \"ra\\nmp\" under \"shapes\"",
        ),
        (
            "[3, 0]",
            "[3, 2e9]",
            "bodies[1].position: position or displacement 2000000000 m on axis 1 is beyond 1000000000 m: move the origin",
        ),
        ("0.25", "1e200", "bodies[1].rotation: 1e200 is more than an f32 can hold"),
        ("0.25", "[0, 0, 0, 1]", "bodies[1].rotation: one number belongs here"),
        (
            "[2, 0]",
            "[2000, 0]",
            "bodies[2].linear_velocity: its length, 2e3, is more than the 1000 that a scene may ask for",
        ),
        (
            "-3",
            "-3e3",
            "bodies[2].angular_velocity: its length, 3e3, is more than the 1000 that a scene may ask for",
        ),
        (
            "\"fixed\": true",
            "\"fixed\": true, \"angular_velocity\": 1",
            "bodies[0].fixed: a fixed body has no velocity: leave one of the two out",
        ),
        ("[31]", "[1, 32]", "bodies[2].layers.collides_with[1]: there is no layer 32: give 0 to 31"),
    ];
    for (from, to, expected) in by_path {
        assert_eq!(refused(PLANE, from, to), expected);
    }
}

#[test]
fn content_faults_name_their_path_in_space() {
    let by_path = [
        ("\"dimension\": 3", "\"dimension\": 2", "gravity: 2 numbers belong here, and there are 3"),
        (
            "[0, 0, 3, 3]",
            "[0, 0, 0, 0]",
            "bodies[0].rotation: the rotation is zero: use the identity for no rotation",
        ),
        (
            "[0, 0, 3, 3]",
            "[1e-60, 0, 0, 0]",
            "bodies[0].rotation: the rotation is zero: use the identity for no rotation",
        ),
        ("[0, 0, 3, 3]", "[0, 0, 3]", "bodies[0].rotation: 4 numbers belong here, and there are 3"),
        ("[0, 0, 3, 3]", "1", "bodies[0].rotation: a list of 4 numbers: x, y, z, w belongs here"),
        (
            "[0, 1, 0], [0, 0, 1]",
            "[0, 1, 0], [1, 1, 0]",
            "shapes[\"rock\"].hull: the points lie in one plane: use Hull::of_any_dimension, or move one off it",
        ),
        (
            "[0, 0, 1]]",
            "[0, 0, 2e6]]",
            "shapes[\"rock\"].hull: point 3 is more than 1000000 m from the shape's origin: split the shape",
        ),
        (
            "\"sides\": 12",
            "\"sides\": 129",
            "shapes[\"barrel\"].prism.sides: 129 sides are not possible: give 3 to 128",
        ),
        (
            "\"half_height\": 0.75",
            "\"half_height\": -0.75",
            "shapes[\"barrel\"].prism.half_height: -0.75 is not positive: give a length in metres",
        ),
        ("[0, 1, 0] }", "1 }", "bodies[1].angular_velocity: a list of 3 numbers belongs here"),
        (
            "{ \"cuboid\": { \"half_extents\": [1, 1, 1] } }",
            "{ \"rect\": { \"half_extents\": [1, 1] } }",
            "shapes[\"crate\"].rect: a rect is a shape of dimension 2, which this scene does not have",
        ),
    ];
    for (from, to, expected) in by_path {
        assert_eq!(refused(VOLUME, from, to), expected);
    }
}

#[test]
fn every_truncation_is_refused() {
    for json in [PLANE, VOLUME] {
        for end in 0..json.len() {
            let fault = Level::from_json(&json[..end]);
            assert!(matches!(fault, Err(LevelError::Json(_))), "cut at byte {end}");
        }
    }
}

#[test]
fn no_single_wrong_byte_panics() {
    for json in [PLANE, VOLUME] {
        for place in 0..json.len() {
            for byte in *b"\0\"-0e[}\xff" {
                let mut broken = json.as_bytes().to_vec();
                broken[place] = byte;
                if let Err(error) = Level::from_json(&broken) {
                    assert!(!error.to_string().is_empty());
                }
            }
        }
    }
}

#[test]
fn deep_nesting_is_refused() {
    let deep = PLANE.replacen("[0, -9.81]", &"[".repeat(100_000), 1);
    assert!(message(&deep).contains("line 3"));
    let deeper = PLANE.replacen("0.25", &"[".repeat(100_000), 1);
    assert!(message(&deeper).contains("line 11"));
}

#[test]
fn the_levels_of_the_examples_are_right() {
    let platformer = include_str!("../../../../examples/scenes/platformer.json");
    let Level::Plane(level) = Level::from_json(platformer).unwrap() else { panic!("it is in the plane") };
    assert!(level.bodies.len() > 100 && level.bodies.iter().any(|body| body.sensor));
    let courtyard = include_str!("../../../../examples/scenes/courtyard.json");
    let Level::Volume(level) = Level::from_json(courtyard).unwrap() else { panic!("it is in space") };
    assert!(level.bodies.len() > 200 && level.bodies.iter().any(|body| body.sensor));
}
