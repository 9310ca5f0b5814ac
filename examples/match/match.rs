//! The game of match.cpp in Rust: `match FILE` keeps its recording, and goes on with one that was
//! saved.
use carom::{Call, Film, Game, Position, RackKind, Recording, RulesKind, TableKind};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = std::env::args().nth(1).ok_or("match FILE")?;
    let table = carom::table(TableKind::Pool9ft)?;
    let cue = carom::cue(Game::Pool);
    let mut rules = carom::built_in_rules(RulesKind::Nineball);
    let (mut game, mut read, mut film) = <(Recording, Recording, Film)>::default();
    let mut lines = std::fs::read_to_string(&file).unwrap_or_default();
    assert!(game.load(&lines)?, "a shot has other bits");
    if lines.is_empty() {
        let rack = carom::rack(RackKind::Nineball, &table, 1e-4, 2)?;
        lines = game.begin(&table, &rack, &Default::default())?;
        rules.state.opening = 1; // before the break
        lines += &game.stand(RulesKind::Nineball, &rules.state, 0)?;
    }
    let (mut winner, mut frames, mut loudest) = (-1, 0, 0.0_f64); // N s
    while winner < 0 {
        // the game is kept; the player thinks, while the shot of the other is drawn
        std::fs::write(&file, &lines)?;
        let player = game.standing().2;
        rules.state = *game.standing().1;
        let rating = [500.0, 600.0][player as usize];
        let mut position = Position::new(&table, game.layout()?, &cue, &rules, rating);
        position.options.shots = 300;
        let errors = position.player;
        let mut mind = position.think(500, 1, game.in_hand())?;
        let begun = frames;
        while !mind.go_on()? {
            if let Some(shot) = game.last() {
                film.at(shot, f64::from(frames - begun) / 60.0)?;
            }
            frames += 1;
        }
        let best = mind.choices()[0];

        // the stroke, and how it sounds
        if game.in_hand() {
            lines += &game.place(0, best.place[0], best.place[1])?;
        }
        lines += &game.shoot(&carom::strike(&errors, 1, game.shots() as u64, &best.cue))?;
        let shot = game.last().ok_or("no shot")?;
        let blows = shot.events().iter().map(|event| event.impulse);
        loudest = blows.fold(loudest, f64::max);

        // the ruling, and the layout that it leaves
        let (ball, pocket) = (best.ball, best.pocket);
        let ruling = shot.referee(&rules, Call { ball, pocket }, 0)?;
        println!("{}: {}", player + 1, carom::words(&ruling));
        lines += &game.settle(&ruling, 0)?;
        if ruling.winner >= 0 {
            winner = player ^ i64::from(ruling.winner);
        } else {
            let next = player ^ i64::from(ruling.next);
            lines += &game.stand(RulesKind::Nineball, &ruling.state, next)?;
        }
    }
    lines += &game.end()?;
    std::fs::write(&file, &lines)?;
    winner += 1;
    println!("player {winner} wins; {frames} frames, the hardest blow {loudest:.4} N s");

    // a reader plays every shot again, and compares its bits
    assert!(read.load(&lines)? && read.ended());
    Ok(())
}
