//! Models from documents that the tests make.
