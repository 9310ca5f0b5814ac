/*
 * A whole game of nine-ball between two programs of unlike strength: match FILE keeps its
 * recording.  Each thinks in slices, beside the film of the shot before, errs as players of his
 * rating do, and is ruled by the library. Where FILE holds a game that was saved on its way, by
 * whichever program, this
 * one goes on. Match.cs, match.rs, match.mjs and match.py are the same game, byte for byte. */
#include <carom.hpp>

#include <cstdio>
#include <fstream>
#include <iterator>

int main(int count, char **arguments) try {
  const char *file = count == 2 ? arguments[1] : throw std::invalid_argument("match FILE");
  const carom_table table = carom::table(CAROM_TABLE_POOL_9FT);
  const carom_player players[] = {carom_player_fargo(500.0), carom_player_fargo(600.0)};
  const carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  carom_plan_rules rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
  carom_plan_options options{};
  options.shots = 300;
  std::ifstream saved(file, std::ios::binary);
  std::string lines{std::istreambuf_iterator<char>(saved), {}};
  carom::recording game, read;
  if (!game.load(lines))
    throw std::runtime_error("a shot has other bits than were recorded");
  if (lines.empty()) {
    lines = game.begin(table, carom::rack(CAROM_RACK_NINEBALL, table, 1e-4, 2));
    rules.state.opening = 1; // before the break
    lines += carom::stand(game, CAROM_RULES_NINEBALL, rules.state, 0);
  }
  carom::film film;
  int winner = -1, frames = 0;
  double loudest = 0.0; // N s
  while (winner < 0) {
    // the game is kept; the player thinks, while the shot of the other is drawn
    std::ofstream(file, std::ios::binary) << lines;
    rules.state = game.game().standing;
    const int player = static_cast<int>(game.game().player);
    carom_plan_job job = carom::job(table, game.layout(), cue, players[player], rules);
    job.options = &options;
    carom::thinking mind(job, 500, 1, game.game().hand == 1);
    for (int frame = 0; !mind.ended(); frame++, frames++) {
      mind.go_on();
      if (game.game().shots > 0)
        film.at(game.last(), frame / 60.0);
    }
    const carom_choice best = mind.choices()[0];

    // the stroke, and how it sounds
    if (game.game().hand == 1) {
      game.place(0, best.place[0], best.place[1]);
      lines += game.write(CAROM_RECORD_PLACE);
    }
    lines += game.shoot(carom::strike(players[player], 1, game.game().shots, best.cue));
    for (const carom_event &event : game.last().events())
      loudest = event.impulse > loudest ? event.impulse : loudest;

    // the ruling, and the layout that it leaves
    const carom_ruling ruling = carom::referee(rules, game.last(), {best.ball, best.pocket});
    std::printf("%d: %s\n", player + 1, carom::words(ruling).c_str());
    lines += carom::settle(game, ruling);
    winner = ruling.winner < 0 ? -1 : player ^ ruling.winner;
    if (winner < 0)
      lines += carom::stand(game, CAROM_RULES_NINEBALL, ruling.state, player ^ ruling.next);
  }
  lines += game.write(CAROM_RECORD_END);
  std::ofstream(file, std::ios::binary) << lines;
  std::printf("player %d wins; %d frames, hardest %.4f N s\n", winner + 1, frames, loudest);

  // a reader plays every shot again, and compares its bits
  return read.load(lines) && read.game().kind == CAROM_RECORD_END ? 0 : 1;
} catch (const std::exception &wrong) {
  std::fprintf(stderr, "match: %s\n", wrong.what());
  return 1;
}
