// Plans: which stroke to play, by built-in or custom rules.
using System;
using System.Collections.Generic;
using System.Runtime.ExceptionServices;
using System.Runtime.InteropServices;

namespace Carom {
  /// <summary>Marks a static method that C calls, as IL2CPP requires.</summary>
  [AttributeUsage(AttributeTargets.Method)]
  sealed class MonoPInvokeCallbackAttribute : Attribute {
    public MonoPInvokeCallbackAttribute(System.Type type) {
    }
  }

  /// <summary>Custom rules of a game. Sets of balls have bit k for ball k. The methods may be
  /// called from several threads at once, and must depend only on their arguments; `user` has seven
  /// integers of the state for the rules, from the view of the player at the table; the eighth
  /// identifies the object, which lives as long as the program. An exception of a method is thrown
  /// at the end of the call that made the plan or the ruling. carom_plan.h describes the
  /// methods.</summary>
  public abstract unsafe class GameRules {
    const int Own = 7;
    static readonly List<GameRules> all = new List<GameRules>();
    static readonly Native.carom_rules_on on = OnOf;
    static readonly Native.carom_rules_judge judge = JudgeOf;
    static readonly Native.carom_rules_left left = LeftOf;
    static readonly Native.carom_rules_pockets pockets = PocketsOf;
    static readonly Native.carom_rules_value value = ValueOf;
    static readonly Native.carom_rules_points points = PointsOf;
    static readonly Native.carom_rules_settle settle = SettleOf;
    readonly ulong number;
    Exception failure; // the last one
    int failures;      // their number

    /// <summary>The balls that may be met first, and potted.</summary>
    protected abstract uint On(ulong[] user, uint inPlay);
    /// <summary>The outcome of a shot; it leaves `user` from the view of the next player.</summary>
    protected abstract Turn Judge(ulong[] user, uint inPlay, int cueBall, Facts facts, Call call);
    /// <summary>How many balls the player at the table, [0], and the opponent, [1], have to pot to
    /// win; in a race for points, how many points.</summary>
    protected abstract int[] Left(ulong[] user, uint inPlay);

    // The library has defaults for the methods below. Override those that your rules need.

    /// <summary>The pockets in which balls count for the player at the table, as a set.</summary>
    protected virtual uint Pockets(ulong[] user) {
      throw new NotImplementedException();
    }
    /// <summary>The chance that the player at the table wins, 0 to 1; without an opponent, the
    /// expected number of balls that this player still pots.</summary>
    protected virtual double Value(ulong[] user, BallState[] layout, bool inHand) {
      throw new NotImplementedException();
    }
    /// <summary>In a race for points, the points of a ball that falls in the next stroke; for ball
    /// -1, the mean of a later pot.</summary>
    protected virtual double Points(ulong[] user, uint inPlay, int ball) {
      throw new NotImplementedException();
    }
    /// <summary>Applies the rules that depend on the positions of the balls after a stroke was
    /// judged, and spots the balls of turn.spot, as Billiards.Spot() does.</summary>
    protected virtual void Settle(ulong[] user, Table table, ShotBall[] balls, ref Turn turn) {
      throw new NotImplementedException();
    }
    delegate void Settling(ulong[] user, Table table, ShotBall[] balls, ref Turn turn);

    protected GameRules() {
      lock (all) {
        number = (ulong)all.Count;
        all.Add(this);
      }
    }

    /// <summary>The rules with a state that is all 0; `calls`, `race` and other members can be
    /// set.</summary>
    public PlanRules Data() {
      var data = new PlanRules {
        on = Marshal.GetFunctionPointerForDelegate(on),
        judge = Marshal.GetFunctionPointerForDelegate(judge),
        left = Marshal.GetFunctionPointerForDelegate(left),
        pockets = Overridden((Func<ulong[], uint>)Pockets, pockets),
        value = Overridden((Func<ulong[], BallState[], bool, double>)Value, value),
        points = Overridden((Func<ulong[], uint, int, double>)Points, points),
        settle = Overridden((Settling)Settle, settle),
      };
      data.state.user[Own] = number;
      return data;
    }

    static IntPtr Overridden(Delegate method, Delegate callback) {
      return method.Method.DeclaringType == typeof(GameRules)
                 ? IntPtr.Zero
                 : Marshal.GetFunctionPointerForDelegate(callback);
    }

    [MonoPInvokeCallback(typeof(Native.carom_rules_on))]
    static uint OnOf(RulesState *state, uint inPlay) {
      return Guarded(state, (rules, user) => rules.On(user, inPlay));
    }

    [MonoPInvokeCallback(typeof(Native.carom_rules_judge))]
    static Turn JudgeOf(RulesState *state, uint inPlay, int cueBall, Facts *facts, Call call) {
      return Guarded(state, (rules, user) => {
        var turn = rules.Judge(user, inPlay, cueBall, *facts, call);
        Keep(state, user);
        return turn;
      });
    }

    [MonoPInvokeCallback(typeof(Native.carom_rules_left))]
    static void LeftOf(RulesState *state, uint inPlay, int *to) {
      to[0] = to[1] = 1;
      Guarded(state, (rules, user) => {
        var balls = rules.Left(user, inPlay);
        to[1] = balls[1];
        return to[0] = balls[0];
      });
    }

    [MonoPInvokeCallback(typeof(Native.carom_rules_pockets))]
    static uint PocketsOf(RulesState *state) {
      return Guarded(state, (rules, user) => rules.Pockets(user));
    }

    [MonoPInvokeCallback(typeof(Native.carom_rules_value))]
    static double ValueOf(RulesState *state, BallState *layout, int count, int inHand) {
      return Guarded(state, (rules, user) => {
        var states = new BallState[count];
        for (int k = 0; k < count; k++)
          states[k] = layout[k];
        return rules.Value(user, states, inHand != 0);
      });
    }

    [MonoPInvokeCallback(typeof(Native.carom_rules_points))]
    static double PointsOf(RulesState *state, uint inPlay, int ball) {
      return Guarded(state, (rules, user) => rules.Points(user, inPlay, ball));
    }

    [MonoPInvokeCallback(typeof(Native.carom_rules_settle))]
    static void SettleOf(RulesState *state, Table *table, ShotBall *balls, int count, Turn *turn) {
      Guarded(state, (rules, user) => {
        var layout = Billiards.Copy(balls, count);
        rules.Settle(user, *table, layout, ref * turn);
        for (int k = 0; k < count; k++)
          balls[k] = layout[k];
        Keep(state, user);
        return 0;
      });
    }

    static void Keep(RulesState *state, ulong[] user) {
      for (int k = 0; k < Own; k++)
        state->user[k] = user[k];
    }

    /// No exception passes through C: the call that uses the rules throws it at its end.
    static T Guarded<T>(RulesState *state, Func<GameRules, ulong[], T> call) {
      GameRules rules;
      lock (all) rules = all[(int)state->user[Own]];
      var user = new ulong[Own];
      for (int k = 0; k < Own; k++)
        user[k] = state->user[k];
      try {
        return call(rules, user);
      } catch (Exception error) {
        lock (all) {
          rules.failure = error;
          rules.failures++;
        }
        return default(T);
      }
    }

    /// <summary>Throws the exceptions of custom rules that occurred since it was made.</summary>
    internal struct Watch {
      readonly GameRules rules;
      readonly int before;

      internal Watch(PlanRules of) {
        rules = null;
        before = 0;
        if (of.on != Marshal.GetFunctionPointerForDelegate(on))
          return;
        lock (all) {
          rules = all[(int)of.state.user[Own]];
          before = rules.failures;
        }
      }

      internal Exception Failure {
        get { lock (all) return rules != null && rules.failures != before ? rules.failure : null; }
      }

      internal Status Check(Status status, PlanJob *job = null) {
        if (Failure != null)
          ExceptionDispatchInfo.Capture(Failure).Throw();
        return Billiards.Check(status, job);
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
    /// <summary>The bounds of a cue ball in hand, as in a match. Null: the bounds of the game after
    /// a foul, if a plan is made in hand. After a scratch on the break of eight-ball, set the
    /// bounds of the ruling, because the rules do not know the previous stroke.</summary>
    public HandBounds? Bounds;
    /// <summary>The bounds within which the cue ball was placed for this stroke: from behind the
    /// head string it may not first meet balls that are there too.</summary>
    public Leave Leave;

    /// <summary>For two players of the same Fargo rating, 200 to 850, in this game. They play as
    /// rated if the shots of the options are 0.</summary>
    public Position(Table table, ShotBall[] balls, Cue cue, PlanRules rules, double rating) {
      Table = table;
      Balls = balls;
      Cue = cue;
      Rules = rules;
      Player = Opponent = Calls.PlayerRated(rating, (RulesKind)(rules.learned - 1));
    }

    /// <summary>The best strokes, best first, at most `most`; in hand, with the positions of the
    /// cue ball.</summary>
    public PlanStroke[] Plan(int most = 1, bool inHand = false) {
      using (var all = Think(0, most, inHand)) {
        all.GoOn();
        return all.Choices;
      }
    }

    /// <summary>A plan of the position as it is now, made in slices of about `slice` events (500
    /// take 1 ms), between the frames of a game.</summary>
    public Thinking Think(long slice, int most = 1, bool inHand = false) {
      return new Thinking(this, slice, most, inHand || Bounds != null);
    }

    /// <summary>The chances of the caller's strokes, in their order.</summary>
    public PlanStroke[] Chances(Cue[] cues) {
      var told = new PlanStroke[cues.Length];
      using (var held = new Held(this, 0)) fixed(Cue * of = cues) fixed(PlanStroke * to = told)
          held.Rules.Check(Native.carom_plan_try(held.Job, of, cues.Length, to), held.Job);
      return told;
    }

    /// <summary>The chance that the player at the table wins, without playing a shot.</summary>
    public double Value(bool inHand = false) {
      double value;
      using (var held = new Held(this, 0))
          held.Rules.Check(Native.carom_plan_value(held.Job, inHand ? 1 : 0, &value), held.Job);
      return value;
    }
  }

  /// <summary>The members of a position that the library reads, pinned so that the collector does
  /// not move them.</summary>
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
    internal readonly GameRules.Watch Rules;
    internal PlanJob *Job {
      get { return parts != null ? &parts->job : throw new ObjectDisposedException("Thinking"); }
    }

    internal Held(Position of, long slice) {
      Rules = new GameRules.Watch(of.Rules);
      var options = of.Options;
      options.stop = null;
      options.opponent = null;
      options.slice = slice;
      var memory = Native.carom_plan_memory(&options);
      if (memory == UIntPtr.Zero) {
        var rejected = new PlanJob { options = &options };
        Billiards.Check(Status.ErrorOptions, &rejected);
      }
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
        leave = (long)of.Leave,
      };
    }

    public void Dispose() {
      Marshal.FreeHGlobal((IntPtr)parts);
      parts = null;
      GC.SuppressFinalize(this);
    }

    ~Held() {
      Marshal.FreeHGlobal((IntPtr)parts);
    }
  }

  /// <summary>A plan in progress.</summary>
  public sealed unsafe class Thinking : IDisposable {
    readonly Held held;
    readonly PlanStroke[] room;
    HandBounds bounds;
    readonly bool inHand;
    bool begun;

    /// <summary>Whether it has ended, with or without an error.</summary>
    public bool Ended { get; private set; }
    /// <summary>The best strokes, best first; empty until the end.</summary>
    public PlanStroke[] Choices { get; private set; } = new PlanStroke[0];

    internal Thinking(Position of, long slice, int most, bool inHand) {
      held = new Held(of, slice);
      room = new PlanStroke[most];
      this.inHand = inHand;
      var leave = of.Leave;
      if (inHand && of.Bounds == null && leave < Leave.Anywhere)
        leave = LeaveAfterFoul(of);
      held.Job->leave = (long)leave;
      bounds = of.Bounds ?? Calls.HandBounds(leave, of.Table, 0.0);
    }

    static Leave LeaveAfterFoul(Position of) {
      var about = Native.carom_rules_about_of((RulesKind)(of.Rules.learned - 1));
      return about != null ? (Leave)about->hand : Leave.Anywhere;
    }

    /// <summary>Plays a slice. Returns whether the plan has ended.</summary>
    public bool GoOn() {
      if (Ended)
        return true;
      int found = 0;
      Status status;
      var within = bounds;
      fixed(PlanStroke *to = room) {
        if (begun)
          status = Native.carom_plan_continue(held.Job, to, room.Length, &found);
        else if (inHand)
          status = Native.carom_plan_hand(held.Job, (double *)&within.low, (double *)&within.high,
                                          to, room.Length, &found);
        else
          status = Native.carom_plan(held.Job, to, room.Length, &found);
      }
      begun = true;
      Ended = status < 0 || found > 0 || held.Rules.Failure != null;
      held.Rules.Check(status, held.Job);
      Choices = new PlanStroke[found];
      Array.Copy(room, Choices, found);
      return Ended;
    }

    public void Dispose() {
      held.Dispose();
    }
  }
}
