//! The keys of what is drawn beside a scene.

use super::super::error::{Fault, Within};
use super::super::keys::Scene;
use super::super::support;
use super::check_method;

/// So many are drawn beside a scene at most: more would be too small to be compared.
pub(super) const MOST: usize = 5;

/// Errors: too many entries; a title of no letters; a method that the form excludes, or that cannot run the scene.
pub(super) fn check(scene: &Scene) -> Result<(), Fault> {
    if scene.beside.len() > MOST {
        let message = format!("has {} entries: there is room for {MOST} beside a scene", scene.beside.len());
        return Err(Fault::invalid(message));
    }
    for (i, entry) in scene.beside.iter().enumerate() {
        if entry.title.as_ref().is_some_and(|title| title.trim().is_empty()) {
            return Err(Fault::invalid("is empty: give it words, or leave it out").at("title").item(i));
        }
        let title = scene.companion_title(entry);
        check_method(&entry.method).map_err(|fault| fault.at("method").of(&title)).item(i)?;
        let companion = scene.companion(entry);
        let can_run = support::check(&companion).and_then(|()| support::method(&companion).map(|_| ()));
        can_run.map_err(|fault| fault.elsewhere().of(&title)).item(i)?;
    }
    Ok(())
}
