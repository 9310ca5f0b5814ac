//! Names of values as people write them: "9-ball" is `RulesKind::Nineball`. The library has the
//! names and their synonyms.
use crate::{calls, sys, Error, Status, Words};
use std::ffi::CString;

/// An enumeration whose values have names, such as `TableKind`.
pub trait Named: TryFrom<i32> {
    /// Which names they are.
    const WORDS: Words;
}

/// The names of an enumeration, in the order of its values.
pub fn names<T: Named>() -> Vec<String> {
    // More numbers than any enumeration has, with gaps; then the flags of `Choice`.
    (0..64)
        .chain((6..=16).map(|bit| 1 << bit))
        .filter_map(|value| calls::word(T::WORDS, value))
        .collect()
}

/// The value that a name stands for. Capitals, hyphens and underscores do not matter, and synonyms
/// count. The error quotes an unknown name, and suggests the name that was probably meant.
pub fn named<T: Named>(text: &str) -> Result<T, Error> {
    let value = CString::new(text).map_or(-1, |name| unsafe {
        sys::carom_word_value(T::WORDS.into(), name.as_ptr())
    });
    T::try_from(value).map_err(|_| {
        let known = names::<T>();
        let hint = suggestion(text, &known).map_or("; use".to_string(), |name| {
            format!("; did you mean \"{name}\"? Use")
        });
        Error {
            status: Status::ErrorOptions,
            fault: format!("unknown name \"{text}\"{hint} one of {}", known.join(", ")),
        }
    })
}

/// The name that a misspelt one resembles: at most a third of its letters differ.
fn suggestion<'a>(text: &str, known: &'a [String]) -> Option<&'a String> {
    let letters_of = |word: &str| -> Vec<char> {
        word.to_lowercase()
            .chars()
            .filter(|letter| letter.is_alphanumeric())
            .collect()
    };
    let letters = letters_of(text);
    let distances = known
        .iter()
        .map(|name| (distance(&letters, &letters_of(name)), name));
    let (nearest, name) = distances.min_by_key(|(apart, _)| *apart)?;
    let is_near = nearest < letters.len() && nearest <= (letters.len() / 3).max(1);
    is_near.then_some(name)
}

/// How many letters must be inserted, deleted, replaced, or exchanged with the next one to turn one
/// word into the other.
fn distance(a: &[char], b: &[char]) -> usize {
    let mut rows: Vec<Vec<usize>> = vec![(0..=b.len()).collect()];
    for i in 1..=a.len() {
        let mut row = vec![i];
        for k in 1..=b.len() {
            let replaced = rows[i - 1][k - 1] + usize::from(a[i - 1] != b[k - 1]);
            let mut least = replaced.min(row[k - 1] + 1).min(rows[i - 1][k] + 1);
            if i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1] {
                least = least.min(rows[i - 2][k - 2] + 1);
            }
            row.push(least);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Choice, Condition, EventType, RackKind, RulesKind, ShotCushion, TableKind};

    /// A name with its last two letters exchanged, or with one letter more.
    fn misspelt(name: &str) -> String {
        let mut letters: Vec<char> = name.chars().collect();
        let last = letters.len() - 1;
        letters.swap(last - 1, last);
        let turned: String = letters.into_iter().collect();
        if turned == name {
            turned + "x"
        } else {
            turned
        }
    }

    fn every_name<T: Named + PartialEq + std::fmt::Debug>() {
        let known = names::<T>();
        assert!(known.len() > 1);
        for name in &known {
            let value = named::<T>(name).unwrap();
            assert_eq!(
                named::<T>(&name.replace('_', "-").to_uppercase()),
                Ok(value)
            );
            let wrong = misspelt(name);
            let fault = named::<T>(&wrong).unwrap_err().to_string();
            assert!(
                fault.starts_with(&format!("unknown name \"{wrong}\"; ")),
                "{fault}"
            );
            assert!(
                fault.contains(&format!("did you mean \"{name}\"?")),
                "{fault}"
            );
        }
    }

    #[test]
    fn quotes_and_corrects_a_misspelt_name() {
        every_name::<TableKind>();
        every_name::<RackKind>();
        every_name::<RulesKind>();
        every_name::<ShotCushion>();
        every_name::<Condition>();
        every_name::<EventType>();
        every_name::<Choice>();
        let fault = named::<TableKind>("billiards room")
            .unwrap_err()
            .to_string();
        assert!(
            fault.starts_with("unknown name \"billiards room\"; use one of "),
            "{fault}"
        );
        assert!(named::<TableKind>("9\0ft").is_err() && named::<TableKind>("").is_err());
    }

    #[test]
    fn reads_the_synonyms_of_the_library() {
        for name in ["9-ball", "9ball", "Nine-ball", "nineball"] {
            assert_eq!(named(name), Ok(RulesKind::Nineball));
        }
        assert_eq!(named("9-foot"), Ok(TableKind::Pool9ft));
    }
}
