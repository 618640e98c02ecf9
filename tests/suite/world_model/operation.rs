//! What may be done to a world, one after the other.

use proptest::prelude::*;

/// One thing done to a world. Bodies are named by the order in which they came, gone ones included.
#[derive(Clone, Debug)]
pub(super) enum Operation {
    Insert {
        seed: u64,
    },
    InsertMany {
        seed: u64,
    },
    /// A mesh, a height field, a chain.
    Ground {
        seed: u64,
    },
    Move {
        body: usize,
        seed: u64,
    },
    /// Some bodies at once, with keys of gone ones among them.
    MoveMany {
        seed: u64,
    },
    /// Moves a body by a hair, or by a few of them.
    Nudge {
        body: usize,
        seed: u64,
    },
    /// Moves a body to where grids touch.
    Settle {
        body: usize,
        seed: u64,
    },
    /// Moves a body to where it is.
    Stay {
        body: usize,
    },
    /// Says what a body is about to do.
    Motion {
        body: usize,
        seed: u64,
    },
    Remove {
        body: usize,
    },
    /// Changes what a body is.
    Change {
        body: usize,
        seed: u64,
    },
    Clear,
    /// Goes on with a clone.
    Clone,
    /// Goes on with what a text of the world gives.
    Restore,
    Update,
    /// Updates with both hooks.
    UpdateWith {
        seed: u64,
    },
    /// Updates where so many pairs are allowed.
    UpdateWithin {
        most: usize,
    },
}

type Weighted = (u32, BoxedStrategy<Operation>);

fn of_seed(weight: u32, make: fn(u64) -> Operation) -> Weighted {
    (weight, any::<u64>().prop_map(make).boxed())
}

fn of_body(weight: u32, make: fn(usize, u64) -> Operation) -> Weighted {
    (weight, (0..1_usize << 20, any::<u64>()).prop_map(move |(body, seed)| make(body, seed)).boxed())
}

/// Bodies that come, jump, change and go: of their contacts every bit is known.
fn of_jumps() -> Vec<Weighted> {
    vec![
        of_seed(40, |seed| Operation::Insert { seed }),
        of_body(40, |body, seed| Operation::Move { body, seed }),
        of_body(10, |body, _| Operation::Stay { body }),
        of_body(20, |body, _| Operation::Remove { body }),
        (1, Just(Operation::Clear).boxed()),
        of_body(30, |body, seed| Operation::Change { body, seed }),
        (30, Just(Operation::Update).boxed()),
        of_seed(10, |seed| Operation::UpdateWith { seed }),
        (8, (0..120_usize).prop_map(|most| Operation::UpdateWithin { most }).boxed()),
    ]
}

pub(super) fn jump() -> impl Strategy<Value = Operation> {
    proptest::strategy::Union::new_weighted(of_jumps())
}

/// Everything that can be done to a world.
pub(super) fn anything() -> impl Strategy<Value = Operation> {
    let mut all = of_jumps();
    all.extend([
        of_seed(3, |seed| Operation::InsertMany { seed }),
        of_seed(6, |seed| Operation::Ground { seed }),
        of_seed(5, |seed| Operation::MoveMany { seed }),
        of_body(60, |body, seed| Operation::Nudge { body, seed }),
        of_body(20, |body, seed| Operation::Settle { body, seed }),
        of_body(15, |body, seed| Operation::Motion { body, seed }),
        (1, Just(Operation::Clone).boxed()),
        (1, Just(Operation::Restore).boxed()),
        (20, Just(Operation::Update).boxed()),
    ]);
    proptest::strategy::Union::new_weighted(all)
}
