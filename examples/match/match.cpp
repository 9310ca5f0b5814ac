/* A whole game of nine-ball between two programs of unlike strength: match FILE keeps its recording.
 *
 * Each thinks in slices, beside the film of the shot before, errs as players of his rating do, and is
 * ruled by the library. Match.cs, match.rs, match.mjs and match.py are the same game, byte for byte. */
#include <carom.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>

int main(int count, char **arguments) try {
  if (count != 2)
    throw std::invalid_argument("match FILE");
  const carom_table table = carom::table(CAROM_TABLE_POOL_9FT);
  const carom_player players[] = {carom_player_fargo(500.0), carom_player_fargo(600.0)};
  const carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  carom_plan_rules rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
  rules.state.opening = 1; // before the break
  carom_plan_options options{};
  options.shots = 300;
  carom::recording game;
  std::string lines = game.begin(table, carom::rack(CAROM_RACK_NINEBALL, table, 1e-4, 2));
  carom::film film;
  int player = 0, winner = -1, frames = 0;
  double loudest = 0.0; // N s
  for (std::uint64_t number = 0; winner < 0; number++) {
    // how the game stands is kept; the player thinks, while the shot of the other is drawn
    lines += carom::stand(game, CAROM_RULES_NINEBALL, rules.state, player);
    carom_plan_job job = carom::job(table, game.layout(), cue, players[player], rules);
    job.options = &options;
    carom::thinking mind(job, 500, 1, game.game().hand == 1);
    for (int frame = 0; !mind.ended(); frame++, frames++) {
      mind.go_on();
      if (number > 0)
        film.at(game.last(), frame / 60.0);
    }
    const carom_choice best = mind.choices()[0];

    // the stroke, and how it sounds
    if (game.game().hand == 1) {
      game.place(0, best.place[0], best.place[1]);
      lines += game.write(CAROM_RECORD_PLACE);
    }
    game.game().cue = best.cue;
    carom_player_strike(&players[player], 1, number, &game.game().cue);
    game.play();
    lines += game.write(CAROM_RECORD_SHOT);
    for (const carom_event &event : game.last().events())
      loudest = std::max(loudest, event.impulse);

    // the ruling, and the layout that it leaves
    const carom_ruling ruling = carom::referee(rules, game.last(), {best.ball, best.pocket});
    std::printf("%d: %s\n", player + 1, carom::words(ruling).c_str());
    rules.state = ruling.state;
    lines += carom::settle(game, ruling);
    player = ruling.next == 1 ? 1 - player : player;
    winner = ruling.winner == 1 ? 1 - player : ruling.winner == 0 ? player : -1;
  }
  lines += game.write(CAROM_RECORD_END);
  std::ofstream(arguments[1], std::ios::binary) << lines;
  std::printf("player %d wins; %d frames, the hardest blow %.4f N s\n", winner + 1, frames,
              loudest);

  // a reader plays every shot again, and compares its bits
  carom::recording read;
  std::ifstream file(arguments[1]);
  for (std::string line; std::getline(file, line);) {
    read.read(line);
    if (read.game().pending == 1 && (read.play(), !read.same()))
      throw std::runtime_error("a shot has other bits than were recorded");
  }
  return read.game().kind == CAROM_RECORD_END ? 0 : 1;
} catch (const std::exception &wrong) {
  std::fprintf(stderr, "match: %s\n", wrong.what());
  return 1;
}
