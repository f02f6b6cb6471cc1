//! Scene documents, the registry of named scenes, mesh files in and recordings out.

pub mod recording;
