//! One program of tests, each held against a scene whose depths are known in closed form.

#[cfg(test)]
mod scene;

#[cfg(test)]
mod maps;
#[cfg(test)]
mod pairs;
#[cfg(test)]
mod planes;
#[cfg(test)]
mod surfaces;
