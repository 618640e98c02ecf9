//! What asunder guarantees. One line a guarantee; the module of that name proves it.
mod oracles;
