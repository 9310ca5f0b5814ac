// The game of match.c in C++: match FILE STROKES.
#include <carom.hpp>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

int main(int count, char **arguments) try {
  const char *file = count == 3 ? arguments[1] : throw std::invalid_argument("match FILE STROKES");
  const carom_player players[] = {carom_player_rated(550.0, CAROM_RULES_EIGHTBALL),
                                  carom_player_rated(650.0, CAROM_RULES_EIGHTBALL)};
  carom_plan_options options{};
  options.shots = 300;
  std::ifstream saved(file, std::ios::binary);
  const std::string lines{std::istreambuf_iterator<char>(saved), {}};
  carom::match game;
  if (lines.empty())
    game.begin(CAROM_RULES_EIGHTBALL, carom::table(CAROM_TABLE_POOL_9FT), 5);
  else
    game.load(lines.substr(0, lines.rfind('\n') + 1)); // half a line is what a crash leaves
  for (int k = std::atoi(arguments[2]); k > 0 && !game.over(); k--) {
    const int me = game.seat();
    options.opponent = &players[1 - me];
    const carom_plan_stroke best = game.plan(players[me], options)[0];
    game.take(best, carom::strike(players[me], 9, game.state().record.shots, best.cue));
    std::printf("%d: %s\n", me + 1, game.words().c_str());
    if (game.over())
      game.end();
  }
  std::ofstream(file, std::ios::binary) << game.lines();
} catch (const std::exception &wrong) {
  std::fprintf(stderr, "match: %s\n", wrong.what());
  return 1;
}
