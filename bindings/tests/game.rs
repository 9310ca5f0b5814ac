// As game.c, in Rust.
use carom::{Error, Film, Game, RackKind, Recording, TableKind};

fn add(hash: u64, numbers: &[f64]) -> u64 {
    let bytes = numbers
        .iter()
        .flat_map(|number| number.to_bits().to_le_bytes());
    bytes.fold(hash, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x100000001b3)
    })
}

fn main() -> Result<(), Error> {
    let path = std::env::args().nth(1).expect("the name of a recording");
    let mut recording = Recording::default();
    for line in std::fs::read_to_string(path).expect("a recording").lines() {
        assert!(
            recording.read(line)?,
            "shot {} has other bits than were recorded",
            recording.shots()
        );
    }
    println!(
        "recording: {} shots, {:016x}",
        recording.shots(),
        recording.hash()
    );

    let table = carom::table(TableKind::Pool9ft)?;
    let balls = carom::rack(RackKind::Nineball, &table, 1e-4, 1)?;
    let cue = carom::Cue {
        speed: 8.0,
        ..carom::cue(Game::Pool)
    };
    let shot = carom::shoot(&table, &balls, &cue, &Default::default())?;
    let mut hash = 0xcbf29ce484222325;
    for event in shot.events() {
        hash = add(hash, &[event.time]);
    }
    for state in shot.last() {
        hash = add(add(add(hash, &state.r), &state.v), &state.w);
    }
    println!("break: {} events, {hash:016x}", shot.events().len());

    // The film of the shot in parts.
    let mut film = Film::default();
    let until = |time_most| carom::Options {
        time_most,
        ..Default::default()
    };
    let mut parts = carom::shoot(&table, &balls, &cue, &until(0.2))?;
    let mut frames = 0;
    while f64::from(frames) / 60.0 < shot.time() {
        let time = f64::from(frames) / 60.0;
        if time > parts.time() {
            parts.resume(&table, &until(time + 0.2))?;
        }
        let (states, turned) = film.at(&parts, time)?;
        for (state, turn) in states.iter().zip(turned) {
            hash = add(add(hash, &state.r), turn);
        }
        frames += 1;
    }
    for event in shot.events() {
        hash = add(hash, &[shot.slip(event)]);
    }
    println!("film: {frames} frames, {hash:016x}");
    parts.resume(&table, &until(0.0))?;
    let (all, facts) = (parts.facts(), shot.facts());
    assert!(all.down == facts.down && all.first == facts.first && all.moved == facts.moved);
    Ok(())
}
