// Plans: which stroke to play, by built-in rules or by those of the caller.
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace Carom {
  /// <summary>Marks a static method that C calls, as IL2CPP asks.</summary>
  [AttributeUsage(AttributeTargets.Method)]
  sealed class MonoPInvokeCallbackAttribute : Attribute {
    public MonoPInvokeCallbackAttribute(System.Type type) {
    }
  }

  /// <summary>Rules of a game of the caller's. Sets of balls have bit k for ball k. The methods may
  /// be called from several threads at once, and depend on their arguments only; `user` are the
  /// seven words of the state that are theirs, as the player at the table has them; the eighth
  /// names the object, which lives as long as the program. An exception of theirs ends the program,
  /// as none passes through C.</summary>
  public abstract unsafe class GameRules {
    const int Own = 7;
    static readonly List<GameRules> all = new List<GameRules>();
    static readonly Native.carom_rules_on on = OnOf;
    static readonly Native.carom_rules_judge judge = JudgeOf;
    static readonly Native.carom_rules_left left = LeftOf;
    readonly ulong number;

    /// <summary>The balls that may be met first, and potted.</summary>
    protected abstract uint On(ulong[] user, uint inPlay);
    /// <summary>The outcome of a shot; it leaves `user` as the next player has it.</summary>
    protected abstract Turn Judge(ulong[] user, uint inPlay, int cueBall, Facts facts, Call call);
    /// <summary>How many balls the player at the table, [0], and the other one, [1], have to pot to
    /// win.</summary>
    protected abstract int[] Left(ulong[] user, uint inPlay);

    protected GameRules() {
      lock (all) {
        number = (ulong)all.Count;
        all.Add(this);
      }
    }

    /// <summary>The rules with a state that is all 0; `calls`, `race` and the like can be
    /// set.</summary>
    public PlanRules Data() {
      var data = new PlanRules {
        on = Marshal.GetFunctionPointerForDelegate(on),
        judge = Marshal.GetFunctionPointerForDelegate(judge),
        left = Marshal.GetFunctionPointerForDelegate(left),
      };
      data.state.user[Own] = number;
      return data;
    }

    [MonoPInvokeCallback(typeof(Native.carom_rules_on))]
    static uint OnOf(RulesState *state, uint inPlay) {
      return Guarded(() => Of(state).On(Words(state), inPlay));
    }

    [MonoPInvokeCallback(typeof(Native.carom_rules_judge))]
    static Turn JudgeOf(RulesState *state, uint inPlay, int cueBall, Facts *facts, Call call) {
      return Guarded(() => {
        var words = Words(state);
        var turn = Of(state).Judge(words, inPlay, cueBall, *facts, call);
        for (int k = 0; k < Own; k++)
          state->user[k] = words[k];
        return turn;
      });
    }

    [MonoPInvokeCallback(typeof(Native.carom_rules_left))]
    static void LeftOf(RulesState *state, uint inPlay, int *to) {
      Guarded(() => {
        var balls = Of(state).Left(Words(state), inPlay);
        to[0] = balls[0];
        to[1] = balls[1];
        return 0;
      });
    }

    static GameRules Of(RulesState *state) {
      lock (all) return all[(int)state->user[Own]];
    }

    static ulong[] Words(RulesState *state) {
      var words = new ulong[Own];
      for (int k = 0; k < Own; k++)
        words[k] = state->user[k];
      return words;
    }

    static T Guarded<T>(Func<T> call) {
      try {
        return call();
      } catch (Exception error) {
        Environment.FailFast(error.ToString());
        throw;
      }
    }
  }

  /// <summary>A position for which plans are made.</summary>
  public sealed unsafe class Position {
    public Table Table;
    /// <summary>At rest.</summary>
    public ShotBall[] Balls;
    /// <summary>Its ball, masses and tip; the stroke itself is not read.</summary>
    public Cue Cue;
    public Player Player, Opponent;
    public PlanRules Rules;
    /// <summary>Models and space.</summary>
    public ShotOptions Shot;
    /// <summary>`opponent` and `stop` of it are not read.</summary>
    public PlanOptions Options;

    /// <summary>Of two players of the same rating, 0 to 1000.</summary>
    public Position(Table table, ShotBall[] balls, Cue cue, PlanRules rules, double rating) {
      Table = table;
      Balls = balls;
      Cue = cue;
      Rules = rules;
      Player = Opponent = Native.carom_player_fargo(rating);
    }

    /// <summary>The best strokes, best first, at most `most`; in hand, with the places of the cue
    /// ball.</summary>
    public Choice[] Plan(int most = 1, bool inHand = false) {
      using (var all = Think(0, most, inHand)) {
        all.GoOn();
        return all.Choices;
      }
    }

    /// <summary>A plan of the position as it is now, made in slices of so many events, about (500
    /// take 1 ms), between the frames of a game.</summary>
    public Thinking Think(long slice, int most = 1, bool inHand = false) {
      return new Thinking(this, slice, most, inHand);
    }

    /// <summary>The chances of strokes of the caller's, in their order.</summary>
    public Choice[] Chances(Cue[] cues) {
      var told = new Choice[cues.Length];
      using (var held = new Held(this, 0)) fixed(Cue * of = cues) fixed(Choice * to = told)
          Billiards.Check(Native.carom_plan_try(held.Job, of, cues.Length, to));
      return told;
    }

    /// <summary>The chance that the player at the table wins, without playing a shot.</summary>
    public double Value(bool inHand = false) {
      double value;
      using (var held = new Held(this, 0))
          Billiards.Check(Native.carom_plan_value(held.Job, inHand ? 1 : 0, &value));
      return value;
    }
  }

  /// <summary>What the library reads of a position, where the collector does not move it.</summary>
  sealed unsafe class Held : IDisposable {
    struct Parts {
      public PlanJob job;
      public Table table;
      public Cue cue;
      public Player player, opponent;
      public PlanRules rules;
      public ShotOptions shot;
      public PlanOptions options;
    }
    Parts *parts;
    internal PlanJob *Job {
      get { return parts != null ? &parts->job : throw new ObjectDisposedException("Thinking"); }
    }

    internal Held(Position of, long slice) {
      var options = of.Options;
      options.stop = null;
      options.opponent = null;
      options.slice = slice;
      var memory = Native.carom_plan_memory(&options);
      if (memory == UIntPtr.Zero)
        Billiards.Check(Status.ErrorOptions);
      long balls = (sizeof(Parts) + 15) / 16 * 16,
           room = balls + ((long)sizeof(ShotBall) * of.Balls.Length + 15) / 16 * 16;
      parts = (Parts *)Marshal.AllocHGlobal((IntPtr)(room + (long)memory));
      var ball = (ShotBall *)((byte *)parts + balls);
      for (int k = 0; k < of.Balls.Length; k++)
        ball[k] = of.Balls[k];
      *parts =
          new Parts { table = of.Table, cue = of.Cue,   player = of.Player, opponent = of.Opponent,
                      rules = of.Rules, shot = of.Shot, options = options };
      parts->options.opponent = &parts->opponent;
      parts->job = new PlanJob {
        table = &parts->table,         balls = ball,
        count = of.Balls.Length,       cue = &parts->cue,
        player = &parts->player,       rules = &parts->rules,
        shot = &parts->shot,           options = &parts->options,
        memory = (byte *)parts + room, memorySize = memory,
      };
    }

    public void Dispose() {
      Marshal.FreeHGlobal((IntPtr)parts);
      parts = null;
      GC.SuppressFinalize(this);
    }

    /// <summary>Where the game lets a cue ball in hand be put after a foul.</summary>
    internal Bounds BoundsInHand() {
      Bounds bounds;
      var about = Native.carom_rules_about_of((RulesKind)(Job->rules->learned - 1));
      var leave = about != null ? (Leave)about->hand : Leave.Hand;
      Billiards.Check(Native.carom_hand_bounds(leave, Job->table, 0.0, &bounds));
      return bounds;
    }
    ~Held() {
      Marshal.FreeHGlobal((IntPtr)parts);
    }
  }

  /// <summary>A plan on its way.</summary>
  public sealed unsafe class Thinking : IDisposable {
    readonly Held held;
    readonly Choice[] room;
    readonly bool inHand;
    bool begun;

    /// <summary>Whether it has ended, also by an error.</summary>
    public bool Ended { get; private set; }
    /// <summary>The best strokes, best first; empty until the end.</summary>
    public Choice[] Choices { get; private set; } = new Choice[0];

    internal Thinking(Position of, long slice, int most, bool inHand) {
      held = new Held(of, slice);
      room = new Choice[most];
      this.inHand = inHand;
    }

    /// <summary>Plays a slice. Returns whether the plan has ended.</summary>
    public bool GoOn() {
      if (Ended)
        return true;
      int found = 0;
      Status status;
      var bounds = held.BoundsInHand();
      fixed(Choice *to = room) status =
          begun    ? Native.carom_plan_continue(held.Job, to, room.Length, &found)
          : inHand ? Native.carom_plan_hand(held.Job, (double *)&bounds.low, (double *)&bounds.high,
                                            to, room.Length, &found)
                   : Native.carom_plan(held.Job, to, room.Length, &found);
      begun = true;
      Ended = status < 0 || found > 0;
      Billiards.Check(status);
      Choices = new Choice[found];
      Array.Copy(room, Choices, found);
      return Ended;
    }

    public void Dispose() {
      held.Dispose();
    }
  }
}
