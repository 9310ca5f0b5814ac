// As game.c, in C++ by carom.hpp.
#include <carom.hpp>

#include <bit>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>

static uint64_t add(uint64_t hash, std::span<const double> numbers) {
  for (const double number : numbers) {
    for (int byte = 0; byte < 8; byte++)
      hash = (hash ^ (std::bit_cast<uint64_t>(number) >> 8 * byte & 255)) * 0x100000001b3u;
  }
  return hash;
}

int main(int, char **arguments) {
  std::ifstream file(arguments[1]);
  carom::recording recording;
  const carom_record &record = recording.game();
  if (!recording.load(std::string(std::istreambuf_iterator<char>(file), {}))) {
    std::fprintf(stderr, "shot %" PRId64 " has other bits than were recorded\n", record.shots);
    return 1;
  }
  std::printf("recording: %" PRId64 " shots, %016" PRIx64 "\n", record.shots, record.hash);

  const carom_table table = carom::table(CAROM_TABLE_POOL_9FT);
  const auto balls = carom::rack(CAROM_RACK_NINEBALL, table, 1e-4, 1);
  carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  cue.speed = 8.0;
  carom_shot_options options{};
  carom::shot shot;
  shot.play(table, balls, cue, options);
  uint64_t hash = 0xcbf29ce484222325u;
  for (const carom_event &event : shot.events())
    hash = add(hash, {&event.time, 1});
  for (const carom_ball_state &state : shot.final_states())
    hash = add(add(add(hash, state.r), state.v), state.w);
  std::printf("break: %zu events, %016" PRIx64 "\n", shot.events().size(), hash);

  /* the film of the shot in parts */
  carom::film film;
  carom::shot parts;
  options.time_most = 0.2;
  parts.play(table, balls, cue, options);
  int frames = 0;
  for (; frames / 60.0 < shot.time(); frames++) {
    options.time_most = frames / 60.0 + 0.2;
    if (frames / 60.0 > parts.time())
      parts.resume(table, options);
    const auto [states, turned] = film.at(parts, frames / 60.0);
    for (std::size_t k = 0; k < states.size(); k++)
      hash = add(add(hash, states[k].r), turned[k]);
  }
  for (const carom_event &event : shot.events()) {
    const double slip = shot.slip(event);
    hash = add(hash, {&slip, 1});
  }
  std::printf("film: %d frames, %016" PRIx64 "\n", frames, hash);

  /* a stroke while balls move is refused with the reason */
  options.time_most = 0.2;
  carom::recording stopped;
  stopped.begin(table, balls, options);
  stopped.shoot(cue);
  try {
    stopped.shoot(cue);
    return 1;
  } catch (const carom::error &wrong) {
    return std::strstr(wrong.what(), "balls move") == nullptr;
  }
}
