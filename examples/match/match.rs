//! The game of match.cpp in Rust: `match FILE` keeps its recording.
use carom::{sys, Call, Film, Position, Recording};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = std::env::args().nth(1).ok_or("match FILE")?;
    let table = carom::table(sys::CAROM_TABLE_POOL_9FT)?;
    let cue = carom::cue(sys::CAROM_GAME_POOL);
    let mut rules = carom::built_in_rules(sys::CAROM_RULES_NINEBALL);
    rules.state.opening = 1; // before the break
    let (mut game, mut film) = (Recording::default(), Film::default());
    let rack = carom::rack(sys::CAROM_RACK_NINEBALL, &table, 1e-4, 2)?;
    let mut lines = game.begin(&table, &rack, &Default::default())?;
    let (mut player, mut winner, mut frames, mut number) = (0, 0, 0, 0);
    let mut loudest: f64 = 0.0; // N s
    while winner == 0 {
        // how the game stands is kept; the player thinks, while the shot of the other is drawn
        lines += &game.stand(sys::CAROM_RULES_NINEBALL, &rules.state, player as i64)?;
        let mut position =
            Position::new(&table, game.layout()?, &cue, &rules, [500.0, 600.0][player]);
        position.options.shots = 300;
        let errors = position.player;
        let mut mind = position.think(500, 1, game.in_hand())?;
        let mut frame = 0;
        while !mind.go_on()? {
            if let Some(shot) = game.last() {
                film.at(shot, f64::from(frame) / 60.0)?;
            }
            frame += 1;
        }
        frames += frame + 1;
        let best = mind.choices()[0];

        // the stroke, and how it sounds
        if game.in_hand() {
            lines += &game.place(0, best.place[0], best.place[1])?;
        }
        lines += &game.shoot(&carom::strike(&errors, 1, number, &best.cue))?;
        let shot = game.last().ok_or("no shot")?;
        for event in shot.events() {
            loudest = loudest.max(event.impulse);
        }

        // the ruling, and the layout that it leaves
        let call = Call {
            ball: best.ball,
            pocket: best.pocket,
        };
        let ruling = shot.referee(&rules, call, 0)?;
        println!("{}: {}", player + 1, carom::words(&ruling));
        rules.state = ruling.state;
        lines += &game.settle(&ruling, 0)?;
        player ^= usize::from(ruling.next == 1);
        if ruling.winner >= 0 {
            winner = 1 + (player ^ ruling.winner as usize);
        }
        number += 1;
    }
    lines += &game.end()?;
    std::fs::write(&file, &lines)?;
    println!("player {winner} wins; {frames} frames, the hardest blow {loudest:.4} N s");

    // a reader plays every shot again, and compares its bits
    let mut read = Recording::default();
    for line in std::fs::read_to_string(&file)?.lines() {
        assert!(read.read(line)?, "a shot has other bits than were recorded");
    }
    assert!(read.ended());
    Ok(())
}
