//! Tests on a graphics adapter, which can be a software renderer. Without an adapter, the tests print a message and
//! pass.

mod adapter;
mod drawing;
mod editing;
mod modelling;
mod textures;
mod times;
mod tools;
mod window;
