//! Tests of pictures and figures through the public interface.

mod extremes;
mod figures;
mod goldens;
