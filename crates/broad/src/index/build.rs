//! Builds a tree from sorted boxes.

use super::node::{Node, Sides, WIDTH};
use super::order::{Item, Scratch, sort};

/// Builds the tree over the boxes whose numbers are in `items`.
pub(super) struct Builder<'a, F> {
    pub(super) sides: F,
    pub(super) items: &'a mut [Item],
    pub(super) scratch: &'a mut Scratch,
    pub(super) nodes: &'a mut Vec<Node>,
}

/// How some items are sorted.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Order {
    /// Not at all yet.
    None,
    /// By keys, which are not all equal.
    Keys,
    /// Their keys are equal; they are split by count.
    Any,
}

/// A range of items.
#[derive(Clone, Copy, Debug)]
struct Part {
    start: usize,
    end: usize,
    order: Order,
}

impl Part {
    const fn len(&self) -> usize {
        self.end - self.start
    }
}

/// Depth from which parts are split by count, whatever their keys: from there on, every node has eight equal parts.
const DEEP: usize = 20;

/// Greatest depth of the tree, with 2^31 boxes.
pub(super) const MOST_DEPTH: usize = DEEP + 11;

impl<F: Fn(u32) -> Sides> Builder<'_, F> {
    pub(super) fn build(&mut self) {
        if !self.items.is_empty() {
            self.node(Part { start: 0, end: self.items.len(), order: Order::None }, 0);
        }
    }

    /// Appends the node of a part, and those below it; returns its number and the box around it.
    fn node(&mut self, part: Part, depth: usize) -> (u32, Sides) {
        let number = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        let mut parts = Parts::of(part);
        if part.len() > WIDTH {
            self.split(part, depth, &mut parts);
        }
        let (inner, loose) = parts.inner_first();
        let (mut node, mut around) = (Node::EMPTY, NOTHING);
        for part in inner {
            let (child, sides) = self.node(*part, depth + 1);
            around = union(&around, &sides);
            node.push(&sides, child, true);
        }
        for part in loose {
            for &item in &self.items[part.start..part.end] {
                let sides = (self.sides)(item as u32);
                around = union(&around, &sides);
                node.push(&sides, item as u32, false);
            }
        }
        self.nodes[number] = node;
        (number as u32, around)
    }

    /// Splits the largest part until there are eight, or all are small.
    fn split(&mut self, part: Part, depth: usize, parts: &mut Parts) {
        let Part { start, mut end, mut order } = part;
        if depth >= DEEP {
            // Giants among giants could be set apart again and again; at this depth they are split by count like all
            // others.
            order = Order::Any;
        } else if order == Order::None {
            let ordinary = start + sort(&mut self.items[start..end], self.scratch, &self.sides);
            if ordinary < end {
                parts.push(Part { start: ordinary, end, order: Order::None });
            }
            end = ordinary;
            order = if self.is_uniform(start, end) { Order::Any } else { Order::Keys };
        }
        parts.parts[0] = Part { start, end, order };
        while let Some(place) = parts.largest() {
            let Part { start, end, order } = parts.parts[place];
            let middle =
                if order == Order::Keys { self.boundary(start, end) } else { start + (end - start) / 2 };
            let [first, second] = [(start, middle), (middle, end)].map(|(start, end)| {
                let is_exhausted = order == Order::Keys && self.is_uniform(start, end);
                Part { start, end, order: if is_exhausted { Order::None } else { order } }
            });
            parts.parts[place] = first;
            parts.push(second);
        }
    }

    fn is_uniform(&self, start: usize, end: usize) -> bool {
        self.items[start] >> 32 == self.items[end - 1] >> 32
    }

    /// The first item whose key has the highest bit set in which keys differ.
    fn boundary(&self, start: usize, end: usize) -> usize {
        let items = &self.items[start..end];
        let (first, last) = (items[0] >> 32, items[items.len() - 1] >> 32);
        let bit = 63 - (first ^ last).leading_zeros();
        let least = (last >> bit) << bit;
        start + items.partition_point(|&item| item >> 32 < least)
    }
}

/// The parts of a node, up to eight.
struct Parts {
    parts: [Part; WIDTH],
    count: usize,
}

impl Parts {
    const fn of(part: Part) -> Self {
        Self { parts: [part; WIDTH], count: 1 }
    }

    const fn push(&mut self, part: Part) {
        self.parts[self.count] = part;
        self.count += 1;
    }

    /// The largest part that is still to be split, while there is room.
    fn largest(&self) -> Option<usize> {
        let is_large = |&place: &usize| {
            self.count < WIDTH && self.parts[place].len() > WIDTH && self.parts[place].order != Order::None
        };
        (0..self.count).filter(is_large).max_by_key(|&place| self.parts[place].len())
    }

    /// The parts that become child nodes, and those whose boxes fit beside them as direct children: parts of a single
    /// box, and the smallest of the others as far as there is room.
    fn inner_first(&mut self) -> (&[Part], &[Part]) {
        let parts = &mut self.parts[..self.count];
        parts.sort_unstable_by_key(|part| (core::cmp::Reverse(part.len()), part.start));
        let (mut room, mut inner) = (WIDTH - parts.len(), parts.len());
        while inner > 0 && parts[inner - 1].len() <= room + 1 {
            inner -= 1;
            room -= parts[inner].len() - 1;
        }
        let (inner, loose) = parts.split_at_mut(inner);
        inner.sort_unstable_by_key(|part| part.start);
        (inner, loose)
    }
}

const NOTHING: Sides =
    [f32::INFINITY, f32::INFINITY, f32::INFINITY, f32::NEG_INFINITY, f32::NEG_INFINITY, f32::NEG_INFINITY];

fn union(one: &Sides, other: &Sides) -> Sides {
    let mut sides = *one;
    for axis in 0..3 {
        sides[axis] = one[axis].min(other[axis]);
        sides[axis + 3] = one[axis + 3].max(other[axis + 3]);
    }
    sides
}

#[cfg(test)]
mod tests {
    use super::*;

    fn depth(nodes: &[Node], number: u32) -> usize {
        let node = &nodes[number as usize];
        let (inner, _) = node.parts(node.present());
        1 + inner.map(|(_, child)| depth(nodes, child)).max().unwrap_or(0)
    }

    /// Boxes at negative powers of two: each halving splits off one power.
    #[test]
    fn no_tree_is_deeper_than_the_stack_of_a_question() {
        for copies in [1, 9, 100] {
            let power = |number: u32| -f32::from_bits((1 + number / copies % 254) << 23);
            let mut items: Vec<Item> = (0..254 * u64::from(copies)).collect();
            let (mut scratch, mut nodes) = (Scratch::default(), Vec::new());
            let sides = |number: u32| [power(number); 6];
            Builder { sides, items: &mut items, scratch: &mut scratch, nodes: &mut nodes }.build();
            let depth = depth(&nodes, 0);
            assert!(depth <= MOST_DEPTH, "{depth} with {copies} copies");
            assert!(copies == 1 || depth > DEEP, "only {depth} with {copies} copies: a test of nothing");
        }
    }
}
