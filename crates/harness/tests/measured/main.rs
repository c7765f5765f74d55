//! What the techniques show, measured with the library against truth and known figures.

#[path = "../support/mod.rs"]
mod support;

mod accuracy;
mod behind_the_eye;
mod coincident;
mod hierarchy;
mod image_order;
mod motion;
mod newton;
mod occluders;
mod proxies;
mod tessellation;
mod textures;
