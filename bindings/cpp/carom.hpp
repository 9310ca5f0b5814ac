/* carom.hpp: the library from C++17, header only. It uses the structs and functions of the C
 * headers, and adds spans for arrays with their lengths, vectors for owned memory, and exceptions
 * if they are enabled.
 *
 * A function that can fail returns its carom_status. With exceptions, a negative status is thrown
 * as carom::error instead; without them (-fno-exceptions) the caller checks it. Positive ones, such
 * as CAROM_STOPPED_AT_TIME, are always returned.
 *
 *     const carom_table table = carom::table(CAROM_TABLE_POOL_9FT);
 *     const std::vector<carom_shot_ball> balls = carom::rack(CAROM_RACK_NINEBALL, table, 1e-4, 1);
 *     carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
 *     cue.speed = 8.0;
 *     carom::shot shot;
 *     shot.play(table, balls, cue);
 *     for (const carom_event &event : shot.events()) ... */
#ifndef CAROM_HPP
#define CAROM_HPP

#if __has_include("carom_plan.h") /* a build without the planner has no such header */
#include "carom_match.h"
#include "carom_plan.h"
#endif
#include "carom_record.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#ifdef __cpp_exceptions
#include <stdexcept>
#endif
#if __cplusplus >= 202002L && __has_include(<span>)
#include <span>
#endif

namespace carom {

#ifdef __cpp_lib_span
using std::span;
#else
/* An array and its length, like std::span of C++20, for C++17. */
template <class T> class span {
public:
  constexpr span() = default;
  constexpr span(T *data, std::size_t size) : data_(data), size_(size) {
  }
  template <class Container, class = decltype(static_cast<T *>(std::declval<Container &>().data()))>
  constexpr span(Container &&of) : data_(of.data()), size_(of.size()) {
  }
  constexpr T *data() const {
    return data_;
  }
  constexpr std::size_t size() const {
    return size_;
  }
  constexpr std::size_t size_bytes() const {
    return size_ * sizeof(T);
  }
  constexpr bool empty() const {
    return size_ == 0;
  }
  constexpr T *begin() const {
    return data_;
  }
  constexpr T *end() const {
    return data_ + size_;
  }
  constexpr T &operator[](std::size_t k) const {
    return data_[k];
  }

private:
  T *data_ = nullptr;
  std::size_t size_ = 0;
};
#endif

#ifdef __cpp_exceptions
/* The error of a call. */
class error : public std::runtime_error {
public:
  explicit error(carom_status code, const std::string &fault = {})
      : std::runtime_error(carom_status_string(code) + (fault.empty() ? "" : ": " + fault)),
        code_(code) {
  }
  carom_status status() const noexcept {
    return code_;
  }

private:
  carom_status code_;
};
#endif

/* Returns the status. If exceptions are enabled, a negative status is thrown, with the fault if it
 * is known. */
inline carom_status checked(carom_status code, [[maybe_unused]] const char *fault = "") {
#ifdef __cpp_exceptions
  if (code < 0)
    throw error(code, fault);
#endif
  return code;
}

/* ---- Impacts */

/* Resolves in[k] to out[k]. The spans have the same length; `status` may be empty. A row in error
 * is not an error of the call: status[k] is its status, and the call returns the first such
 * status. */
inline carom_status collide(span<const carom_impact> in, span<carom_result> out,
                            span<std::int8_t> status = {}, const carom_options &options = {}) {
  if (out.size() != in.size() || (!status.empty() && status.size() != in.size()))
    return checked(CAROM_ERROR_NULL);
  return carom_collide_batch(in.data(), in.size(), &options, out.data(),
                             status.empty() ? nullptr : status.data());
}
inline carom_status cushion(span<const carom_cushion_impact> in, span<carom_motion> out,
                            span<std::int8_t> status = {},
                            const carom_cushion_options &options = {}) {
  if (out.size() != in.size() || (!status.empty() && status.size() != in.size()))
    return checked(CAROM_ERROR_NULL);
  return carom_cushion_batch(in.data(), in.size(), &options, out.data(),
                             status.empty() ? nullptr : status.data());
}

/* ---- Tables and layouts */

inline carom_table table(carom_table_kind kind) {
  carom_table made{};
  checked(carom_table_make(kind, &made));
  return made;
}

/* The measures of a built-in table; and a table made from measures and checked for balls of a
 * radius, m. An error names the wrong measure. */
inline carom_measures measures(carom_table_kind kind) {
  carom_measures made{};
  checked(carom_table_measures(kind, &made));
  return made;
}
inline carom_table table(const carom_measures &by, double radius = 0.028575) {
  carom_table made{};
  carom_table_fault fault{};
  const carom_status status = carom_table_measured(&by, radius, &made, &fault);
  const bool named = fault.part.kind == CAROM_PART_MEASURES;
  checked(status, named ? carom_number_of(fault.part.kind, fault.part.index)->name : "");
  return made;
}

/* A rack, with the cue ball first; empty after an error. */
inline std::vector<carom_shot_ball> rack(carom_rack_kind kind, const carom_table &on, double gap,
                                         std::uint64_t seed) {
  std::vector<carom_shot_ball> balls(static_cast<std::size_t>(carom_rack_size(kind)));
  if (checked(carom_rack(kind, &on, gap, seed, balls.data(), static_cast<int>(balls.size()))) < 0)
    balls.clear();
  return balls;
}

/* Ball in hand: puts balls[ball] at rest at (x, y). If that position is not free, the ball stays,
 * and `in_the_way` is the ball or part in the way; this is not an error here. */
struct placed {
  carom_status status;
  carom_part in_the_way;
};
inline placed place(const carom_table &on, span<carom_shot_ball> balls, int ball, double x,
                    double y) {
  placed made{};
  made.status = carom_place_ball(&on, balls.data(), static_cast<int>(balls.size()), ball, x, y,
                                 &made.in_the_way);
  if (made.status != CAROM_ERROR_OVERLAP && made.status != CAROM_ERROR_OFF_TABLE)
    checked(made.status);
  return made;
}

/* ---- Shots */

/* A shot with its events, however many, and its final states. It keeps the balls with which it
 * began, so that it can compute the states at any time. */
class shot {
public:
  /* Plays the shot; with options.time_most or stop_at only up to that time or event. */
  carom_status play(const carom_table &on, span<const carom_shot_ball> balls, const carom_cue &cue,
                    const carom_shot_options &options = {}) {
    table_ = on;
    balls_.assign(balls.begin(), balls.end());
    if (state_ == nullptr)
      state_ = std::make_unique<carom_shot_state>();
    shot_ = {};
    return with_room(
        [&] { return carom_shoot(&on, balls_.data(), count(), &cue, &options, &shot_); });
  }

  /* Continues a stopped shot. */
  carom_status resume(const carom_table &on, const carom_shot_options &options = {}) {
    return with_room(
        [&] { return carom_shot_continue(&on, balls_.data(), count(), &options, &shot_); });
  }

  span<const carom_event> events() const {
    return {events_.data(), static_cast<std::size_t>(shot_.count)};
  }
  span<const carom_ball_state> final_states() const {
    return final_;
  }
  const carom_facts &facts() const {
    return facts_;
  }
  double time() const {
    return shot_.time;
  }

  /* The layout after the shot. */
  std::vector<carom_shot_ball> layout() const {
    std::vector<carom_shot_ball> balls = balls_;
    for (std::size_t k = 0; k < balls.size(); k++)
      balls[k].state = final_[k];
    return balls;
  }

  /* States and orientations (w, x, y, z) of all balls at a time, s; empty after an error. */
  std::vector<carom_ball_state> states(double time) const {
    std::vector<carom_ball_state> at(balls_.size());
    if (checked(carom_shot_at(balls_.data(), count(), &shot_, time, at.data())) < 0)
      at.clear();
    return at;
  }
  std::vector<std::array<double, 4>> orientations(double time) const {
    std::vector<std::array<double, 4>> turned(balls_.size());
    if (checked(carom_shot_frames(balls_.data(), count(), &shot_, &time, 1, NULL, NULL,
                                  reinterpret_cast<double(*)[4]>(turned.data()))) < 0)
      turned.clear();
    return turned;
  }

  /* The states for drawing: pocketed balls fall in their pockets. */
  std::vector<carom_ball_state> drawn(const carom_table &on, double time) const {
    std::vector<carom_ball_state> at(balls_.size());
    if (checked(carom_shot_drawn(&on, balls_.data(), count(), &shot_, &time, 1, at.data())) < 0)
      at.clear();
    return at;
  }

  /* How fast surfaces pass each other in an event, m/s. Together with the impulse it determines the
   * sound. */
  double slip(const carom_event &event) const {
    return carom_event_slip(&table_, balls_.data(), count(), &event);
  }

  /* shot_ points to the vectors, so a shot can be moved but not copied. A moved-from shot is like a
   * shot that was not played. */
  shot() = default;
  shot(shot &&other) noexcept {
    swap(other);
  }
  shot &operator=(shot &&other) noexcept {
    shot taken(std::move(other));
    swap(taken);
    return *this;
  }
  void swap(shot &other) noexcept {
    std::swap(shot_, other.shot_);
    std::swap(facts_, other.facts_);
    std::swap(table_, other.table_);
    balls_.swap(other.balls_);
    events_.swap(other.events_);
    final_.swap(other.final_);
    state_.swap(other.state_);
  }

private:
  friend class film;
  friend class recording;
#ifdef CAROM_PLAN_H
  friend class match;
#endif
#ifdef CAROM_PLAN_H
  friend carom_ruling referee(const carom_plan_rules &, const shot &, carom_call, int);
#endif

  int count() const {
    return static_cast<int>(balls_.size());
  }

  /* Plays. If there were more events than room, plays again with room for all of them, with the
   * same bits. */
  template <class Play> carom_status with_room(Play play) {
    final_.resize(balls_.size());
    const std::unique_ptr<carom_shot_state> kept =
        shot_.count > 0 && state_ ? std::make_unique<carom_shot_state>(*state_) : nullptr;
    if (events_.empty())
      events_.resize(64);
    for (;;) {
      shot_.events = events_.data();
      shot_.room = static_cast<std::int64_t>(events_.size());
      shot_.final = final_.data();
      shot_.state = state_.get();
      shot_.facts = &facts_;
      const carom_status code = play();
      if (shot_.count <= shot_.room)
        return checked(code);
      events_.resize(static_cast<std::size_t>(shot_.count));
      if (kept != nullptr)
        *state_ = *kept;
    }
  }

  carom_shot shot_{};
  carom_facts facts_{};
  carom_table table_{};
  std::vector<carom_shot_ball> balls_;
  std::vector<carom_event> events_;
  std::vector<carom_ball_state> final_;
  std::unique_ptr<carom_shot_state> state_;
};

/* Frames: for time k of a call, the states of all n balls are states[k n ...], and their
 * quaternions (w, x, y, z) are turned[k n ...]. */
struct frames {
  span<const carom_ball_state> states;
  span<const std::array<double, 4>> turned;
};

/* The frames of shots, for drawing, in which pocketed balls fall: each frame continues from the
 * previous frame if that was earlier in the same shot. */
class film {
public:
  /* Valid until the next call; empty after an error. */
  frames at(const shot &of, span<const double> times) {
    const std::size_t size = times.size() * of.balls_.size();
    states_.resize(size);
    turned_.resize(size);
    if (checked(carom_shot_frames(of.balls_.data(), of.count(), &of.shot_, times.data(),
                                  times.size(), onward_.get(), states_.data(),
                                  reinterpret_cast<double(*)[4]>(turned_.data()))) < 0 ||
        checked(carom_shot_falls(&of.table_, of.balls_.data(), of.count(), &of.shot_, times.data(),
                                 times.size(), states_.data())) < 0)
      return {};
    return {states_, turned_};
  }
  frames at(const shot &of, double time) {
    return at(of, {&time, 1});
  }

private:
  std::unique_ptr<carom_frames> onward_ = std::make_unique<carom_frames>();
  std::vector<carom_ball_state> states_;
  std::vector<std::array<double, 4>> turned_;
};

#ifdef CAROM_PLAN_H
/* ---- Plans */

/* Aims a pot, as carom_aim() does. */
inline carom_status aim(const carom_table &on, span<const carom_shot_ball> balls, carom_pot &pot,
                        carom_cue &cue, const carom_shot_options &options = {}) {
  return checked(
      carom_aim(&on, balls.data(), static_cast<int>(balls.size()), &options, &pot, &cue));
}

/* Judges a shot that was played by the rules, which have the state of the game before it. */
inline carom_ruling referee(const carom_plan_rules &rules, const shot &of,
                            carom_call call = {-1, -1}, int cue_ball = 0) {
  carom_ruling made{};
  carom_shot seen = of.shot_;
  carom_facts facts = of.facts_;
  std::vector<carom_ball_state> last = of.final_;
  seen.facts = &facts;
  seen.final = last.data();
  checked(carom_referee(&rules, &of.table_, of.balls_.data(), of.count(), cue_ball, &seen, call,
                        &made));
  return made;
}
inline std::string words(const carom_ruling &of) {
  std::string text(carom_ruling_string(&of, nullptr, 0), ' ');
  carom_ruling_string(&of, text.data(), text.size() + 1);
  return text;
}

/* The stroke of a player who intends `of`, with errors that follow from the seed and the number of
 * the stroke. */
inline carom_cue strike(const carom_player &by, std::uint64_t seed, std::int64_t number,
                        carom_cue of) {
  carom_player_strike(&by, seed, static_cast<std::uint64_t>(number), &of);
  return of;
}

/* A plan for the player at the table; options, models and memory are not set. */
inline carom_plan_job job(const carom_table &on, span<const carom_shot_ball> balls,
                          const carom_cue &cue, const carom_player &player,
                          const carom_plan_rules &rules) {
  carom_plan_job made{};
  made.table = &on;
  made.balls = balls.data();
  made.count = static_cast<std::int64_t>(balls.size());
  made.cue = &cue;
  made.player = &player;
  made.rules = &rules;
  return made;
}

/* A plan that is made in slices, for an opponent who thinks between the frames of a game.
 * Everything that the job points to must stay unchanged until the end. The memory of the job is
 * allocated here. `in_hand`: 0: the cue ball is not in hand; 1 or true: it is in hand within the
 * bounds that the game sets after a foul; or a carom_leave from CAROM_LEAVE_ANYWHERE on. The rules
 * do not know the previous stroke, so after a scratch on the break of eight-ball, where the cue
 * ball stays behind the head string, pass the `leave` of its ruling. */
class thinking {
public:
  /* A slice has about `slice` events; 0: all at once. `most` is the largest number of strokes to
   * return. */
  explicit thinking(const carom_plan_job &job, std::int64_t slice, int most = 1, int in_hand = 0)
      : job_(job), options_(std::make_unique<carom_plan_options>()), in_hand_(in_hand),
        choices_(static_cast<std::size_t>(most)) {
    if (job.options != nullptr)
      *options_ = *job.options;
    options_->slice = slice;
    memory_.resize(carom_plan_memory(options_.get()) / sizeof(double) + 1);
    job_.options = options_.get();
    job_.memory = memory_.data();
    job_.memory_size = memory_.size() * sizeof(double);
  }
  /* The same for the player at the table of a match, with a cue ball in hand within its bounds. The
   * job needs a player and a cue; the match must stay unchanged until the end. */
  explicit thinking(carom_match &of, const carom_plan_job &job, std::int64_t slice, int most = 1)
      : thinking(job, slice, most) {
    match_ = &of;
  }

  /* Plays a slice. */
  carom_status go_on() {
    const carom_status code =
        begun_ ? carom_plan_continue(&job_, choices_.data(), room(), &found_) : first_slice();
    begun_ = true;
    ended_ = code < 0 || found_ > 0;
    return checked(code, match_ != nullptr ? match_->fault : "");
  }
  /* Whether the plan has ended, with or without an error. */
  bool ended() const {
    return ended_;
  }
  /* The best strokes, best first; empty until the end, and after an error. */
  span<const carom_plan_stroke> choices() const {
    return {choices_.data(), static_cast<std::size_t>(found_)};
  }

private:
  int room() const {
    return static_cast<int>(choices_.size());
  }
  carom_status first_slice() {
    if (match_ != nullptr)
      return carom_match_plan(match_, &job_, choices_.data(), room(), &found_);
    if (in_hand_ == 0)
      return carom_plan(&job_, choices_.data(), room(), &found_);
    if (job_.leave < CAROM_LEAVE_ANYWHERE)
      job_.leave = leave_in_hand();
    return carom_plan_hand(&job_, nullptr, nullptr, choices_.data(), room(), &found_);
  }
  /* The leave of the caller; otherwise the leave that the rules of the game set. */
  int leave_in_hand() const {
    if (in_hand_ >= CAROM_LEAVE_ANYWHERE)
      return in_hand_;
    const auto kind = static_cast<carom_rules_kind>(job_.rules->learned - 1);
    const carom_rules_about *about = carom_rules_about_of(kind);
    return about != nullptr ? about->hand : CAROM_LEAVE_ANYWHERE;
  }

  carom_plan_job job_;
  std::unique_ptr<carom_plan_options> options_;
  int in_hand_;
  carom_match *match_ = nullptr;
  bool begun_ = false, ended_ = false;
  int found_ = 0;
  std::vector<carom_plan_stroke> choices_;
  std::vector<double> memory_;
};

/* The best strokes, best first, at most `most`. The memory of the job is allocated here. */
inline std::vector<carom_plan_stroke> plan(const carom_plan_job &job, int most = 1,
                                           int in_hand = 0) {
  thinking all(job, 0, most, in_hand);
  all.go_on();
  return {all.choices().begin(), all.choices().end()};
}
#endif

/* ---- Recordings */

/* A game that is recorded or read; see carom_record.h. `game()` is the record. Set its table,
 * balls, count, cue and options before you write their lines. */
class recording {
public:
  recording() : game_(std::make_unique<carom_record>()), text_(CAROM_RECORD_TEXT) {
  }

  carom_record &game() {
    return *game_;
  }
  const carom_record &game() const {
    return *game_;
  }

  /* Begins a game: the lines up to that of the balls. */
  std::string begin(const carom_table &on, span<const carom_shot_ball> balls,
                    const carom_shot_options &options = {}) {
    std::string lines;
    if (balls.size() > CAROM_BALLS_MOST) {
      checked(CAROM_ERROR_BALLS);
      return lines;
    }
    game_->table = on;
    game_->options = options;
    game_->count = static_cast<std::int64_t>(balls.size());
    std::copy(balls.begin(), balls.end(), game_->balls);
    for (const auto kind :
         {CAROM_RECORD_HEAD, CAROM_RECORD_TABLE, CAROM_RECORD_OPTIONS, CAROM_RECORD_BALLS})
      lines += write(kind);
    return lines;
  }
  /* The balls after the last shot. */
  span<const carom_shot_ball> layout() {
    carom_record_settle(game_.get());
    return {game_->balls, static_cast<std::size_t>(game_->count)};
  }

  /* The next line of the game, valid until the next call; empty if it cannot be written. */
  std::string_view write(carom_record_kind kind) {
    return {text_.data(), carom_record_write(game_.get(), kind, text_.data(), text_.size())};
  }
  carom_status read(std::string_view line) {
    const carom_status code = carom_record_read(game_.get(), line.data(), line.size());
    return with_fault(code);
  }
  /* Plays a stroke, or continues the shot. last() is then the shot, with all its events. */
  carom_status play(carom_record_kind kind = CAROM_RECORD_SHOT) {
    const auto before = std::make_unique<carom_record>(*game_);
    if (kind != CAROM_RECORD_CONTINUE)
      last_.shot_ = {};
    return last_.with_room([&] {
      *game_ = *before;
      const carom_status code = carom_record_play(game_.get(), kind, &last_.shot_);
      last_.table_ = game_->table;
      last_.facts_ = game_->facts;
      last_.balls_.assign(game_->balls, game_->balls + game_->count);
      last_.final_.assign(game_->final, game_->final + game_->count);
      if (code == CAROM_ERROR_RECORD)
        with_fault(code);
      return code;
    });
  }
  /* Plays a stroke, and returns its line. */
  std::string_view shoot(const carom_cue &cue);
  /* Reads lines and plays their shots. Returns false at a shot whose bits differ from the recorded
   * ones. */
  bool load(std::string_view lines);
  const shot &last() const {
    return last_;
  }
  carom_status place(int ball, double x, double y) {
    return checked(carom_record_place(game_.get(), ball, x, y, nullptr));
  }
  /* Takes a ball in hand; it is out of play until it is placed. */
  carom_status hand(int ball) {
    return checked(carom_record_hand(game_.get(), ball));
  }

  /* Whether the shot of the last line was played, with the bits that were recorded. */
  bool same() const {
    const carom_record_end &is = game_->played, &was = game_->recorded;
    return game_->pending == CAROM_PENDING_LINE && std::memcmp(&is, &was, sizeof is) == 0;
  }

private:
  carom_status with_fault(carom_status code) {
    return checked(code, code == CAROM_ERROR_RECORD ? game_->fault : "");
  }
  std::unique_ptr<carom_record> game_;
  std::vector<char> text_;
  shot last_;
};

inline std::string_view recording::shoot(const carom_cue &cue) {
  game_->cue = cue;
  play();
  return write(CAROM_RECORD_SHOT);
}

inline bool recording::load(std::string_view lines) {
  for (std::size_t size; !lines.empty(); lines.remove_prefix(size)) {
    size = std::min(lines.find('\n'), lines.size() - 1) + 1;
    if (read(lines.substr(0, size)) < 0)
      return false;
    if (game_->pending == CAROM_PENDING_SHOT &&
        (play(static_cast<carom_record_kind>(game_->kind)), !same()))
      return false;
  }
  return true;
}

#ifdef CAROM_PLAN_H
/* A match of carom_match.h. An act that the rules forbid is thrown as carom::error, whose text
 * describes what would be right. */
class match {
public:
  match() : match_(std::make_unique<carom_match>()), scratch_(std::make_unique<carom_record>()) {
  }

  const carom_match &state() const {
    return *match_;
  }
  carom_match &state() {
    return *match_;
  }
  bool over() const {
    return match_->phase == CAROM_MATCH_OVER;
  }
  /* The cue of the seat at the table, for the cue ball: aim it. */
  const carom_cue &cue() const {
    return match_->cue;
  }
  carom_standing standing() const {
    carom_standing made{};
    checked(carom_match_standing(match_.get(), &made));
    return made;
  }
  /* What the match waits for, or how it ended, with names of seats. */
  std::string title() const {
    std::string text(carom_match_string(match_.get(), nullptr, 0), ' ');
    carom_match_string(match_.get(), text.data(), text.size() + 1);
    return text;
  }
  /* The seat that acted last; -1: none has yet. */
  int actor() const {
    return static_cast<int>(match_->record.actor);
  }
  /* The side at the table; in games that each plays for itself, the seat. */
  int side() const {
    return static_cast<int>(match_->record.side);
  }
  /* The seat at the table. */
  int seat() const {
    return match_->seat;
  }
  /* The recording so far, with the lines that were missing in a text that was read and cut off. */
  const std::string &lines() const {
    return lines_;
  }
  /* The last ruling in words. */
  std::string words() const {
    return carom::words(match_->ruling);
  }
  /* The last shot, with all its events. */
  const shot &last() const {
    return last_;
  }

  /* With the rack of a game, to `target` points (0: the usual target of the game), and with equal
   * innings or without. */
  carom_status begin(carom_rules_kind rules, const carom_table &on, std::uint64_t seed,
                     int side = 0, int target = 0, bool equal_innings = false) {
    carom_match_setup setup{};
    setup.rules = rules;
    setup.target = target;
    setup.equal_innings = equal_innings ? 1 : 0;
    setup.table = &on;
    setup.seed = seed;
    setup.side = side;
    return begin(setup);
  }
  /* The same from any layout, by the rules of this kind or by `of`. */
  carom_status begin(carom_rules_kind rules, const carom_table &on,
                     span<const carom_shot_ball> balls, carom_leave leave = CAROM_LEAVE_AFTER,
                     int side = 0, const carom_plan_rules *of = nullptr,
                     const carom_shot_options &options = {}) {
    if (balls.data() == nullptr)
      return CAROM_ERROR_NULL;
    carom_match_setup setup{};
    setup.rules = rules;
    setup.of = of;
    setup.table = &on;
    setup.balls = balls.data();
    setup.count = static_cast<std::int64_t>(balls.size());
    setup.options = &options;
    setup.leave = leave;
    setup.side = side;
    return begin(setup);
  }
  /* With seats, limits or a set: as carom_match_begin_with(). */
  carom_status begin(const carom_match_setup &setup) {
    forget_lines();
    return told(carom_match_begin_with(match_.get(), &setup));
  }
  /* The next match of the set. */
  carom_status next() {
    return told(carom_match_next(match_.get()));
  }
  carom_status choose(carom_choice choice) {
    return told(carom_match_choose(match_.get(), seat(), choice));
  }
  carom_status place(double x, double y) {
    return told(carom_match_place(match_.get(), seat(), x, y));
  }
  carom_status call(int ball, int pocket) {
    return told(carom_match_call(match_.get(), seat(), {ball, pocket}));
  }
  carom_status stroke(const carom_cue &cue, const carom_shot_options &stop = {}) {
    return play(
        true, [&] { return carom_match_stroke(match_.get(), seat(), &cue, &stop, &last_.shot_); });
  }
  carom_status go_on(const carom_shot_options &stop = {}) {
    return play(false, [&] { return carom_match_continue(match_.get(), &stop, &last_.shot_); });
  }
  carom_status concede(int who) {
    return told(carom_match_concede(match_.get(), who));
  }
  carom_status extend() {
    return told(carom_match_extend(match_.get(), seat()));
  }
  carom_status timeout() {
    return told(carom_match_timeout(match_.get(), seat()));
  }
  carom_status clock() {
    return told(carom_match_clock(match_.get(), seat()));
  }
  carom_status end() {
    return told(carom_match_end(match_.get()));
  }
  /* Writes words into the recording: texts by their keys, such as {{"comment", "a kiss"}}, and the
   * time in s that the last stroke took the player, 0: none. docs/reference/files.md has the keys;
   * those of a caller begin with "x_". `who` -1: nobody in particular. */
  carom_status note(int who,
                    std::initializer_list<std::pair<std::string_view, std::string_view>> said,
                    double seconds = 0.0) {
    std::string line = "{\"note\":{";
    for (const auto &[key, text] : said) {
      line += line.back() == '{' ? "\"" : ",\"";
      line += key;
      line += "\":\"";
      for (const char c : text) {
        if (c == '"' || c == '\\')
          line += '\\';
        line += c;
      }
      line += '"';
    }
    line += "}}";

    /* the library reads the texts, as it would those of a file */
    *scratch_ = match_->record;
    scratch_->note = {};
    if (said.size() > 0) {
      const carom_status code = carom_record_read(scratch_.get(), line.data(), line.size());
      if (code < 0)
        return checked(code, scratch_->fault);
    }
    scratch_->note.seconds = seconds;
    return told(carom_match_note(match_.get(), who, &scratch_->note));
  }
  /* The last note. */
  const carom_note &note() const {
    return match_->record.note;
  }

  /* The best strokes of the seat at the table with its cue, whose errors are those of `by`. */
  std::vector<carom_plan_stroke> plan(const carom_player &by, const carom_plan_options &wanted = {},
                                      int most = 1) {
    carom_plan_job job{};
    job.player = &by;
    job.options = &wanted;
    thinking all(*match_, job, 0, most);
    all.go_on();
    restore_text();
    return {all.choices().begin(), all.choices().end()};
  }
  /* Performs the acts that a choice of a plan requires before its stroke. */
  carom_status prepare(const carom_plan_stroke &best) {
    return told(carom_match_prepare(match_.get(), seat(), &best));
  }
  /* Takes a choice of a plan: places, calls and plays its stroke, or passes. `cue` is the stroke as
   * the player makes it; `stop` as of a stroke. */
  carom_status take(const carom_plan_stroke &best, const carom_cue &cue,
                    const carom_shot_options &stop = {}) {
    const carom_status code = prepare(best);
    return code < 0 || best.kind == CAROM_PLAN_PASS ? code : stroke(cue, stop);
  }

  /* Reads and judges the lines of a match, for custom rules with `of`. The last shot has all its
   * events, also if balls are still moving. */
  carom_status load(std::string_view text, const carom_plan_rules &of = {}) {
    if (text.empty())
      return checked(CAROM_ERROR_RECORD, "the text is empty: a match begins with a recording line");
    undone_.clear();
    return read_all(text, of);
  }
  /* Reads the next line of a file. Nothing is read behind a line that is not by the rules. */
  carom_status read(std::string_view line) {
    const std::int64_t shots = match_->record.shots;
    const carom_status code = read_line(line);
    undone_.clear();
    return match_->record.shots != shots ? replay() : code;
  }
  /* Reads a line that a peer of this seat has sent, as carom_match_receive() does; -1: of whoever
   * may send every line. What is refused changes nothing. */
  carom_status receive(std::string_view line, int seat) {
    const std::int64_t shots = match_->record.shots;
    const std::int64_t line_count = match_->record.line;
    if (room_ == nullptr)
      room_ = std::make_unique<carom_match>();
    const carom_status code =
        carom_match_receive(match_.get(), room_.get(), line.data(), line.size(), seat);
    if (code < 0)
      return checked(code, match_->fault);
    if (match_->record.line == line_count)
      return code;
    undone_.clear();
    if (match_->size > 0)
      keep_lines();
    else /* of the beginning, which makes no lines */
      lines_ += with_end(line);
    return match_->record.shots != shots ? replay() : code;
  }
  /* Undoes the last act, by the lines before it; does it again. False: there is none. */
  bool undo() {
    const std::size_t size = carom_match_undone(lines_.data(), lines_.size());
    if (size == lines_.size())
      return false;
    undone_.push_back(lines_.substr(size));
    read_all(std::string(lines_, 0, size), match_->rules);
    return true;
  }
  bool redo() {
    if (undone_.empty())
      return false;
    const std::string text = lines_ + undone_.back();
    undone_.pop_back();
    read_all(text, match_->rules);
    return true;
  }
  /* A copy of the match, independent of this one. */
  match copy() const {
    match made;
    *made.match_ = *match_;
    made.lines_ = lines_;
    made.text_ = text_;
    made.replay();
    return made;
  }

private:
  carom_status read_all(std::string_view text, carom_plan_rules rules) {
    *match_ = {};
    match_->rules = rules;
    forget_lines();
    for (std::size_t size; !text.empty(); text.remove_prefix(size)) {
      size = std::min(text.find('\n'), text.size() - 1) + 1;
      const carom_status code = read_line(text.substr(0, size));
      if (code < 0)
        return code;
    }
    return replay();
  }
  /* Reads a line of a file. lines_ has the lines that are still due already, at its end, and a note
   * comes before them. */
  carom_status read_line(std::string_view line) {
    const carom_record &record = match_->record;
    const std::int64_t line_count = record.line;
    const std::uint64_t hash = record.hash;
    const auto due = static_cast<std::size_t>(match_->due);
    const carom_status code =
        carom_match_read(match_.get(), scratch_.get(), line.data(), line.size());
    if (code < 0)
      return refused(code);
    const bool is_new = record.line != line_count || record.hash != hash;
    if (is_new) /* no blank line, no event, and none that was due */
      lines_.insert(lines_.size() - due, with_end(line));
    if (is_new && due == 0)
      keep_lines();
    else
      text_ = text_of(*match_);
    return code;
  }
  static std::string with_end(std::string_view line) {
    return std::string(line.substr(0, line.find_last_not_of(" \r\n") + 1)) + "\n";
  }
  /* The last shot of a match that was read, with all its events. */
  carom_status replay() {
    last_.shot_ = {};
    if (match_->stroke.mass <= 0)
      return CAROM_OK;
    last_.table_ = match_->record.table;
    last_.balls_.assign(match_->before, match_->before + match_->record.count);
    return last_.with_room([&] { return carom_match_replay(match_.get(), &last_.shot_); });
  }
  /* Keeps the lines of an act; throws an error for a rejected act. */
  carom_status told(carom_status code) {
    if (code < 0 && match_->size == 0)
      return refused(code);
    keep_lines(); /* also those of prepare() before an act that is refused */
    undone_.clear();
    return checked(code, match_->fault);
  }
  void forget_lines() {
    lines_.clear();
    text_ = {};
  }
  /* Adds the lines that the match has made. */
  void keep_lines() {
    lines_.append(match_->text, static_cast<std::size_t>(match_->size));
    text_ = text_of(*match_);
  }
  /* How many bytes of match->text are what. A refused act and a plan change these members, and not
   * the bytes. */
  struct text_size {
    std::int64_t size, known, due;
  };
  static text_size text_of(const carom_match &of) {
    return {of.size, of.known, of.due};
  }
  void restore_text() {
    match_->size = text_.size;
    match_->known = text_.known;
    match_->due = text_.due;
  }
  /* Throws the error of a line or an act that was refused; the lines that are due stay due. */
  carom_status refused(carom_status code) {
    restore_text();
    return checked(code, match_->fault);
  }
  /* Plays, with room for all events. */
  template <class Play> carom_status play(bool new_shot, Play once) {
    const auto before = std::make_unique<carom_match>(*match_);
    const carom_record &record = match_->record;
    if (new_shot) {
      last_.shot_ = {};
      last_.table_ = record.table;
      last_.balls_.assign(record.balls, record.balls + record.count);
    }
    carom_status code = CAROM_OK;
    last_.with_room([&] {
      *match_ = *before;
      code = once();
      last_.facts_ = record.facts;
      last_.final_.assign(record.final, record.final + record.count);
      return CAROM_OK;
    });
    return told(code);
  }

  std::vector<std::string> undone_;
  std::string lines_;
  text_size text_{};
  std::unique_ptr<carom_match> match_;
  std::unique_ptr<carom_record> scratch_;
  std::unique_ptr<carom_match> room_; /* of receive(), once it was called */
  shot last_;
};
#endif

} // namespace carom

#endif /* CAROM_HPP */
