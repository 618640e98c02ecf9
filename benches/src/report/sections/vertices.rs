//! Time against vertices, one plot per query.

use super::{Draft, Figure, marked};
use crate::clock::Spread;
use crate::error::VertexRow;
use crate::report::losses::{distinct, of_vertices};
use crate::report::names::dimension;
use crate::report::palette::{look, rank};
use crate::report::plots::Title;
use crate::report::plots::curves::{Curve, curves};
use crate::report::table::Table;

pub(super) fn draft(rows: &[VertexRow]) -> Draft {
    let mut kinds = distinct(rows, |row| (row.dimension.clone(), row.operation.clone()));
    kinds.sort_by_key(|(dim, _)| dim != "3d");
    Draft {
        heading: "Vertices",
        method: "One question about pairs of shapes of equally many vertices: hulls of 4 to 256, polygons of 3 to 4096. \
                 CPU time of one thread, methods in turns.",
        figures: kinds.iter().map(|(dim, operation)| over_vertices(dim, operation, rows)).collect(),
        findings: Vec::new(),
        losses: of_vertices(rows),
        tables: vec![table(rows)],
    }
}

fn over_vertices(dim: &str, operation: &str, rows: &[VertexRow]) -> Figure {
    let here: Vec<&VertexRow> =
        rows.iter().filter(|row| row.dimension == dim && row.operation == operation).collect();
    let asked = match operation {
        "boolean" => "yes or no",
        "manifold" => "contact points",
        other => other,
    };
    let question = format!("{}, {asked}: what do vertices cost?", dimension(dim));
    let title = Title::new(question.clone(), "Time of a query, one thread; lower is better.");
    let mut methods = distinct(&here, |row| row.method.clone());
    methods.sort_by_key(|method| rank(method));
    let of = |method: &String| {
        let mut points: Vec<(f64, Spread)> = here
            .iter()
            .filter(|row| row.method == *method)
            .map(|row| (f64::from(row.vertices), Spread::new(row.ns, row.ns_low, row.ns_high)))
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Curve { look: look(method), points, is_bound: false }
    };
    let drawn: Vec<Curve> = methods.iter().map(of).collect();
    let mut sizes = distinct(&here, |row| u64::from(row.vertices));
    sizes.sort_unstable();
    let svg = curves(&title, "vertices of each of the two", &sizes, &drawn);
    Figure { file: format!("vertices-{dim}-{operation}"), question, svg }
}

fn table(rows: &[VertexRow]) -> Table {
    let mut methods = distinct(rows, |row| row.method.clone());
    methods.sort_by_key(|method| rank(method));
    let mut table = Table::new("Every number of vertices", &["question", "vertices"]);
    table.head.extend(methods.iter().map(|method| look(method).name));
    for (dim, operation, vertices) in
        distinct(rows, |row| (row.dimension.clone(), row.operation.clone(), row.vertices))
    {
        let mut cells = vec![format!("{}, {operation}", dimension(&dim)), vertices.to_string()];
        cells.extend(methods.iter().map(|method| {
            let of = rows.iter().find(|row| {
                row.method == *method
                    && row.dimension == dim
                    && row.operation == operation
                    && row.vertices == vertices
            });
            of.map_or("-".to_string(), |row| marked(row.ns, row.ns_low, row.ns_high))
        }));
        table.rows.push(cells);
    }
    table
}
