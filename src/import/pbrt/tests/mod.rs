//! The reader as a whole, on files in memory.
