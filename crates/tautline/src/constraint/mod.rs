//! Kernels of constraints: values in, corrections out.
