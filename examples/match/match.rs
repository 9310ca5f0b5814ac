//! The game of match.c in Rust: `match FILE STROKES`.
use carom::{Game, Match, RulesKind, TableKind};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let file = &arguments[1];
    let saved = std::fs::read_to_string(file).unwrap_or_default();
    let mut game = match saved.rfind('\n') {
        Some(end) => Match::load(&saved[..=end])?,
        None => Match::begin(
            RulesKind::Eightball,
            &carom::table(TableKind::Pool9ft)?,
            5,
            0,
        )?,
    };
    for _ in 0..arguments[2].parse()? {
        if game.is_over() {
            break;
        }
        let me = game.seat();
        let mut position = game.position(&carom::cue(Game::Pool), [550.0, 650.0][me]);
        position.opponent = Some(
            game.position(&carom::cue(Game::Pool), [650.0, 550.0][me])
                .player,
        );
        position.options.shots = 300;
        let best = position.plan(1, false)?[0];
        let cue = carom::strike(&position.player, 9, game.shots(), &best.cue);
        game.take(&best, &cue)?;
        println!("{}: {}", me + 1, game.words());
        if game.is_over() {
            game.end()?;
        }
    }
    Ok(std::fs::write(file, game.lines())?)
}
