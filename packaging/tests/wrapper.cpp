// carom.hpp against the calls of C: a shot with more events than its first room, in parts, looked
// at; batches; what is thrown or returned.
#include <carom.hpp>

#include <cstdio>
#include <cstring>
#include <utility>

#define CHECK(...)                                          \
  do                                                        \
    if (!(__VA_ARGS__)) {                                   \
      std::printf("line %d: %s\n", __LINE__, #__VA_ARGS__); \
      return 1;                                             \
    }                                                       \
  while (0)

/* A match: what the rules forbid is refused, and its lines are read again. Plans place a ball in
 * hand within the bounds. */
static int plays_match(const carom_table &table, const carom_cue &cue, const carom_player &player,
                       const carom_plan_options &wanted, const std::vector<carom_shot_ball> &lie) {
  carom::match game;
  CHECK(game.begin(CAROM_RULES_NINEBALL, table, 3, 1) == CAROM_OK && game.side() == 1);
#ifdef __cpp_exceptions
  try {
    game.place(0.6, 1.0);
    CHECK(false);
  } catch (const carom::error &e) {
    CHECK(e.status() == CAROM_ERROR_ACT && std::strstr(e.what(), "0.635") != nullptr);
  }
#else
  CHECK(game.place(0.6, 1.0) == CAROM_ERROR_ACT);
#endif
  carom_plan_job mine{};
  mine.player = &player;
  mine.cue = &cue;
  mine.options = &wanted;
  carom::thinking turn(game.state(), mine, 0);
  CHECK(turn.go_on() == CAROM_OK && turn.choices()[0].place[1] <= 0.635);
  CHECK(game.take(turn.choices()[0], turn.choices()[0].cue) == CAROM_OK);
  CHECK(game.state().rulings == 1 && game.last().events().size() > 1 && !game.words().empty());
  carom::match reader;
  CHECK(reader.load(game.lines()) == CAROM_OK && reader.lines() == game.lines());
  CHECK(reader.state().record.hash == game.state().record.hash);

  // in hand, within the bounds that the game sets after a foul
  carom_plan_rules pocket = carom_plan_rules_of(CAROM_RULES_ONEPOCKET);
  carom_plan_job hand = carom::job(table, lie, cue, player, pocket);
  hand.options = &wanted;
  CHECK(carom::plan(hand, 1, true)[0].place[1] <= 0.635);

  // after a scratch on the break, within those of the ruling
  pocket = carom_plan_rules_of(CAROM_RULES_EIGHTBALL);
  pocket.state.opening = 0;
  CHECK(carom::plan(hand, 1, CAROM_LEAVE_KITCHEN)[0].place[1] <= 0.635);
  return 0;
}

int main() {
  const carom_table table = carom::table(CAROM_TABLE_POOL_9FT);
  const carom_table again_made = carom::table(carom::measures(CAROM_TABLE_POOL_9FT));
  CHECK(std::memcmp(&table, &again_made, sizeof table) == 0);
  const auto balls = carom::rack(CAROM_RACK_EIGHTBALL, table, 1e-4, 3);
  CHECK(balls.size() == 16);
  carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  cue.speed = 8.0;

  // as C plays it
  static carom_event events[512];
  carom_ball_state final[16];
  carom_shot plain{};
  plain.events = events;
  plain.room = 512;
  plain.final = final;
  CHECK(carom_shoot(&table, balls.data(), 16, &cue, nullptr, &plain) == CAROM_OK);
  CHECK(plain.count > 64);

  carom::shot whole;
  CHECK(whole.play(table, balls, cue) == CAROM_OK);
  CHECK(whole.events().size() == static_cast<std::size_t>(plain.count));
  CHECK(std::memcmp(whole.events().data(), events, whole.events().size_bytes()) == 0);
  CHECK(std::memcmp(whole.final_states().data(), final, sizeof final) == 0);
  CHECK(whole.layout()[3].state.r[0] == final[3].r[0]);
  CHECK(whole.states(whole.time())[5].r[1] == final[5].r[1]);
  CHECK(whole.orientations(1.0).size() == 16);
  CHECK(whole.facts().first[0] >= 0);

  // frames, one after the other, many at once, and back
  carom::film film, again;
  const std::array<double, 3> times = {0.1, 1.0, 1.5};
  const auto many = again.at(whole, times);
  CHECK(many.states.size() == 48 && many.turned.size() == 48);
  for (const std::size_t k : {0u, 1u, 2u, 1u}) {
    const auto one = film.at(whole, times[k]);
    const auto states = whole.states(times[k]);
    const auto turned = whole.orientations(times[k]);
    CHECK(std::memcmp(one.states.data(), states.data(), one.states.size_bytes()) == 0);
    CHECK(std::memcmp(one.turned.data(), turned.data(), one.turned.size_bytes()) == 0);
    CHECK(std::memcmp(&many.turned[16 * k], turned.data(), one.turned.size_bytes()) == 0);
    CHECK(std::memcmp(&many.states[16 * k], states.data(), one.states.size_bytes()) == 0);
  }

  // stopped before the events are more than the first room, and gone on with
  carom::shot parts;
  carom_shot_options until{};
  until.time_most = 0.2;
  CHECK(parts.play(table, balls, cue, until) == CAROM_STOPPED_AT_TIME);
  CHECK(parts.resume(table) == CAROM_OK);
  CHECK(std::memcmp(parts.events().data(), events, parts.events().size_bytes()) == 0);
  CHECK(std::memcmp(parts.final_states().data(), final, sizeof final) == 0);
  CHECK(std::memcmp(&parts.facts(), &whole.facts(), sizeof whole.facts()) == 0);
  const auto frame = film.at(parts, 0.5).states;
  CHECK(std::memcmp(frame.data(), whole.states(0.5).data(), frame.size_bytes()) == 0);

  // a shot that was moved is the same; one that was moved from was not played
  carom::shot moved = std::move(parts);
  parts = carom::shot();
  CHECK(moved.events().size() == whole.events().size() && parts.events().empty());
  CHECK(moved.states(1.0)[2].r[0] == whole.states(1.0)[2].r[0]);
  CHECK(moved.play(table, balls, cue, until) == CAROM_STOPPED_AT_TIME);
  parts = std::move(moved);
  CHECK(parts.resume(table) == CAROM_OK && parts.facts().first[0] == whole.facts().first[0]);
  CHECK(whole.drawn(table, 1.0).size() == 16);

  // ball in hand, and a pot that is aimed
  auto lain = balls;
  const auto taken = carom::place(table, lain, 0, lain[1].state.r[0], lain[1].state.r[1]);
  CHECK(taken.status == CAROM_ERROR_OVERLAP && taken.in_the_way.kind == CAROM_PART_BALL &&
        taken.in_the_way.index == 1);
  CHECK(carom::place(table, lain, 0, 0.4, 0.4).status == CAROM_OK && lain[0].state.r[0] == 0.4);
  std::vector<carom_shot_ball> two(lain.begin(), lain.begin() + 2);
  CHECK(carom::place(table, two, 1, 0.9, 1.6).status == CAROM_OK);
  carom_pot pot{};
  pot.ball = 1;
  pot.pocket = 5;
  carom_cue aimed = carom_cue_of(CAROM_GAME_POOL);
  CHECK(carom::aim(table, two, pot, aimed) == CAROM_OK && pot.outcome == CAROM_POT_FALLS);

  // a plan in slices, which is moved meanwhile
  const carom_player player = carom_player_of(1.0);
  const carom_plan_rules rules = carom_plan_rules_of(CAROM_RULES_POTTING);
  carom_plan_options wanted{};
  wanted.shots = 200;
  const auto lie = whole.layout();
  carom_plan_job job = carom::job(table, lie, cue, player, rules);
  job.options = &wanted;
  const auto planned = carom::plan(job, 2);
  carom::thinking begun(job, 30, 2);
  CHECK(begun.go_on() == CAROM_OK && !begun.ended() && begun.choices().empty());
  carom::thinking thinks = std::move(begun);
  int slices = 1;
  for (; !thinks.ended(); slices++)
    CHECK(thinks.go_on() == CAROM_OK);
  CHECK(slices > 5 && thinks.choices().size() == planned.size());
  CHECK(std::memcmp(thinks.choices().data(), planned.data(), thinks.choices().size_bytes()) == 0);

  CHECK(plays_match(table, cue, player, wanted, lie) == 0);

  // batches of impacts
  std::array<carom_cushion_impact, 2> in{};
  in[0] = {{0.5, 1.2, 0}, {0, 0, 0}, {0, 1}, 0.0365, 0.028575, 0.17, 0.2, 0.2, 0.85, 0};
  in[1] = in[0];
  in[1].mass = -1.0;
  std::array<carom_motion, 2> out{};
  std::array<std::int8_t, 2> status{};
  carom_motion one;
  CHECK(carom_cushion(in.data(), nullptr, &one) == CAROM_OK);
  CHECK(carom::cushion(in, out, status) == CAROM_ERROR_MASS && status[0] == CAROM_OK);
  CHECK(std::memcmp(&one, out.data(), sizeof one) == 0);
  std::array<carom_impact, 1> pair{};
  std::array<carom_result, 1> results{};
  CHECK(carom::collide(pair, results) < 0);

  // errors
  cue.speed = -1.0;
#ifdef __cpp_exceptions
  try {
    whole.play(table, balls, cue);
    CHECK(false);
  } catch (const carom::error &e) {
    CHECK(e.status() == CAROM_ERROR_CUE_SPEED && std::strstr(e.what(), "cue.speed") != nullptr);
  }
#else
  CHECK(whole.play(table, balls, cue) == CAROM_ERROR_CUE_SPEED);
#endif
  return 0;
}
