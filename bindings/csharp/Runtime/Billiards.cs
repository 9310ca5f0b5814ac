// Tables, racks, shots and recordings without pointers; plans are in Plans.cs. Calls has the other
// functions that need no pointers, and Native has all functions as C declares them.
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using System.Text;

namespace Carom {
  /// <summary>The error of a call.</summary>
  public sealed class CaromException : Exception {
    public readonly Status Status;

    internal CaromException(string fault, Status status) : base(fault) {
      Status = status;
    }

    internal unsafe CaromException(Status status, string more = null)
        : base(Calls.StatusString(status) + (more == null ? "" : ": " + more)) {
      Status = status;
    }
  }

  /// <summary>A shot that was played.</summary>
  public sealed unsafe class PlayedShot {
    /// <summary>Ok; or StoppedAtTime or StoppedAtEvent, as the options request.</summary>
    public Status Status { get; internal set; }
    /// <summary>All events, in the order in which they happened.</summary>
    public ShotEvent[] Events { get; internal set; }
    /// <summary>The states at the end, one for each ball.</summary>
    public BallState[] Final { get; internal set; }
    /// <summary>The time up to which the shot was followed, s.</summary>
    public double Time { get; internal set; }
    /// <summary>The facts for rules.</summary>
    public Facts Facts { get; internal set; }
    internal Table table;
    internal ShotBall[] balls;
    ShotState[] state; // for a shot that its options may stop

    internal PlayedShot(Table on, ShotBall[] layout, bool stops) {
      table = on;
      balls = (ShotBall[])layout.Clone();
      Final = new BallState[balls.Length];
      Events = new ShotEvent[0];
      state = stops ? new ShotState[1] : null;
    }

    internal delegate Status Playing(Shot *to);

    /// <summary>Plays a stroke of a recording or a match from `balls`, with room for all its
    /// events: `takeBack` undoes a try that had too little room. `last` becomes the shot.</summary>
    internal static Status Recorded(Record *of, ShotBall *balls, ref PlayedShot last, bool goesOn,
                                    Playing play, Action takeBack) {
      var shot = new PlayedShot(of->table, Billiards.Copy(balls, of->count), false);
      var first = goesOn && last != null ? last.Events : shot.Events;
      for (long room = first.Length + 256;;) {
        var events = new ShotEvent[room];
        first.CopyTo(events, 0);
        var data = new Shot { room = room };
        fixed(ShotEvent *to = events) {
          data.events = to;
          shot.Status = play(&data);
        }
        if (data.count <= room) {
          Array.Resize(ref events, (int)data.count);
          shot.Events = events;
          shot.Time = data.time;
          shot.Facts = of->facts;
          for (int k = 0; k < shot.Final.Length; k++)
            shot.Final[k] = ((BallState *)&of->final)[k];
          if (shot.Status >= 0 || data.count > 0)
            last = shot;
          return shot.Status;
        }
        room = data.count;
        takeBack();
      }
    }

    /// <summary>Continues a shot that its options stopped, with the bits of the uninterrupted shot;
    /// `options` set when to stop again. After an error the shot is as before.</summary>
    public Status Resume(Table table, ShotOptions options = default(ShotOptions)) {
      if (state == null)
        throw new CaromException(Status.ErrorState);
      var kept = (BallState[])Final.Clone();
      var status = Follow(Events.Length + 64, &table, null, &options);
      if (status < 0)
        Final = kept;
      return Billiards.Check(status);
    }

    /// <summary>Plays from the current state of the shot, with room for `room` events; plays again
    /// if there were more. Without a cue it continues the shot.</summary>
    internal Status Follow(long room, Table *table, Cue *cue, ShotOptions *options) {
      for (;;) {
        var events = new ShotEvent[room];
        Events.CopyTo(events, 0);
        var stopped = state == null ? null : (ShotState[])state.Clone();
        var facts = Facts;
        var data = new Shot { room = room, facts = &facts };
        Status status;
        fixed(ShotBall *of = balls) fixed(BallState * final = Final) fixed(ShotState *at = stopped)
            fixed(ShotEvent *to = events) {
          data.events = to;
          data.final = final;
          data.state = at;
          status = cue == null ? Native.carom_shot_continue(table, of, balls.Length, options, &data)
                               : Native.carom_shoot(table, of, balls.Length, cue, options, &data);
        }
        if (status < 0)
          return status;
        if (data.count <= room) {
          Array.Resize(ref events, (int)data.count);
          Events = events;
          Time = data.time;
          Facts = facts;
          state = stopped;
          return Status = status;
        }
        room = data.count;
      }
    }

    /// <summary>The layout after the shot.</summary>
    public ShotBall[] Layout() {
      var layout = (ShotBall[])balls.Clone();
      for (int k = 0; k < layout.Length; k++)
        layout[k].state = Final[k];
      return layout;
    }

    /// <summary>The states at a time for drawing, s: pocketed balls fall in their
    /// pockets.</summary>
    public BallState[] Drawn(Table table, double time) {
      var states = new BallState[balls.Length];
      fixed(ShotBall *of = balls) fixed(ShotEvent *events = Events) fixed(BallState *to = states) {
        var shot = Data(events);
        Billiards.Check(
            Native.carom_shot_drawn(&table, of, balls.Length, &shot, &time, (UIntPtr)1, to));
      }
      return states;
    }

    /// <summary>The slip between the surfaces in an event, m/s. Together with the impulse it
    /// determines the sound.</summary>
    public double Slip(ShotEvent of) {
      return Calls.EventSlip(table, balls, of);
    }

    /// <summary>What the library reads of it.</summary>
    internal Shot Data(ShotEvent *events) {
      var shot = new Shot { events = events, room = Events.Length, count = Events.Length };
      shot.time = Time;
      shot.slopeX = table.slopeX;
      shot.slopeY = table.slopeY;
      return shot;
    }

    /// <summary>The states of all balls at a time, s.</summary>
    public BallState[] At(double time) {
      var states = new BallState[balls.Length];
      fixed(ShotBall *of = balls) fixed(ShotEvent *events = Events) fixed(BallState *to = states) {
        var shot = Data(events);
        Billiards.Check(Native.carom_shot_at(of, balls.Length, &shot, time, to));
      }
      return states;
    }
  }

  /// <summary>The frames of shots, for drawing, in which pocketed balls fall: each frame continues
  /// from the previous one if that was earlier in the same shot.</summary>
  public sealed unsafe class Film {
    readonly Frames[] onward = new Frames[1];

    /// <summary>The states of all balls at the time of the last call. The next one writes into the
    /// same array.</summary>
    public BallState[] States { get; private set; }
    /// <summary>How the balls have turned since the start of the shot: w, x, y, z of each,
    /// consecutively.</summary>
    public double[] Turned { get; private set; }

    /// <summary>Goes to a time of a shot, s.</summary>
    public void At(PlayedShot shot, double time) {
      int count = shot.balls.Length;
      if (States == null || States.Length != count) {
        States = new BallState[count];
        Turned = new double[4 * count];
      }
      fixed(ShotBall *balls = shot.balls) fixed(Table *table = &shot.table)
          fixed(ShotEvent *events = shot.Events) fixed(Frames *film = onward)
              fixed(BallState *states = States) fixed(double *turned = Turned) {
        var data = shot.Data(events);
        Billiards.Check(
            Native.carom_shot_frames(balls, count, &data, &time, (UIntPtr)1, film, states, turned));
        Billiards.Check(
            Native.carom_shot_falls(table, balls, count, &data, &time, (UIntPtr)1, states));
      }
    }
  }

  /// <summary>A number of a ball, a cue or a table, or an option: its names, unit, range as a text,
  /// default, and description.</summary>
  public sealed class Row {
    public string Name, Key, Unit, Range, Text;
    public double Low, High, Other;
  }

  /// <summary>What the library offers to a game.</summary>
  public static unsafe class Billiards {
    /// <summary>The revision of the physics: players in lockstep agree only with the same
    /// revision.</summary>
    public static int PhysicsRevision {
      get { return Calls.PhysicsRevision(); }
    }

    /// <summary>The version of the library that runs.</summary>
    public static string Version {
      get { return Calls.Version(); }
    }

    /// <summary>A built-in table.</summary>
    public static Table Table(TableKind kind) {
      return Calls.TableMake(kind);
    }

    /// <summary>The measures of a built-in table.</summary>
    public static Measures Measures(TableKind kind) {
      return Calls.TableMeasures(kind);
    }

    /// <summary>A table from its measures, checked for balls of a radius, m. The exception names
    /// the invalid measure.</summary>
    public static Table Table(Measures measures, double radius = 0.028575) {
      Table table;
      TableFault fault;
      var status = Native.carom_table_measured(&measures, radius, &table, &fault);
      if (fault.part.kind == PartKind.Measures)
        throw new CaromException(status, Rows(PartKind.Measures)[fault.part.index].Name);
      Check(status);
      return table;
    }

    /// <summary>A rack, with the cue ball first. `gap`, m, is between neighbours; `seed` draws the
    /// displacements.</summary>
    public static ShotBall[] Rack(RackKind kind, Table table, double gap = 1e-4, ulong seed = 1) {
      var balls = new ShotBall[Calls.RackSize(kind)];
      fixed(ShotBall *to = balls)
          Check(Native.carom_rack(kind, &table, gap, seed, to, balls.Length));
      return balls;
    }

    /// <summary>The usual cue of a game.</summary>
    public static Cue Cue(Game game) {
      return Calls.CueOf(game);
    }

    /// <summary>Plays a shot until nothing moves, or until the options stop it. The balls are not
    /// changed.</summary>
    public static PlayedShot Play(Table table, ShotBall[] balls, Cue cue,
                                  ShotOptions options = default(ShotOptions)) {
      var shot = new PlayedShot(
          table, balls, options.timeMost > 0 || options.stopAt != 0 || options.firstOf != 0);
      // Most shots have fewer events.
      var status = shot.Follow(256, &table, &cue, &options);
      if (status < 0)
        fixed(ShotBall *of = balls) throw Refused(status, &table, of, balls.Length, &cue, &options);
      return shot;
    }

    /// <summary>Aims a pot: `cue.phi` becomes the direction in which `pot.ball` goes to the middle
    /// of `pot.pocket`, by way of `pot.via`. `pot.outcome` is the result with the other balls and
    /// the jaws.</summary>
    public static void Aim(Table table, ShotBall[] balls, ref Pot pot, ref Cue cue,
                           ShotOptions options = default(ShotOptions)) {
      Pot of = pot;
      Cue aimed = cue;
      fixed(ShotBall *layout = balls) {
        var status = Native.carom_aim(&table, layout, balls.Length, &options, &of, &aimed);
        if (status < 0)
          throw Refused(status, &table, layout, balls.Length, &aimed, &options);
      }
      pot = of;
      cue = aimed;
    }

    /// <summary>Built-in rules, with the state after the break.</summary>
    public static PlanRules Rules(RulesKind kind) {
      return Calls.PlanRulesOf(kind);
    }

    /// <summary>The ruling of a played shot; the rules have the state of the game before
    /// it.</summary>
    public static Ruling Referee(PlanRules rules, PlayedShot shot, Call? call = null,
                                 int cueBall = 0) {
      Ruling made;
      var watch = new GameRules.Watch(rules);
      Facts facts = shot.Facts;
      fixed(Table *table = &shot.table) fixed(ShotBall *balls = shot.balls)
          fixed(BallState * final = shot.Final) {
        var seen = new Shot { facts = &facts, final = final };
        watch.Check(Native.carom_referee(&rules, table, balls, shot.balls.Length, cueBall, &seen,
                                         call ?? new Call { ball = -1, pocket = -1 }, &made));
      }
      return made;
    }

    /// <summary>The text of a ruling.</summary>
    public static string Words(ref Ruling of) {
      return Calls.RulingString(ref of);
    }

    /// <summary>The stroke of a player who intends `cue`, with errors drawn from `seed` and the
    /// number of the stroke.</summary>
    public static Cue Strike(Player player, ulong seed, ulong number, Cue cue) {
      Calls.PlayerStrike(player, seed, number, ref cue);
      return cue;
    }

    /// <summary>Ball in hand: puts a ball at rest at x, y (m). False if that position is not free;
    /// `inTheWay` is the ball or part in the way, and the ball does not move.</summary>
    public static bool Place(Table table, ShotBall[] balls, int ball, double x, double y,
                             out Part inTheWay) {
      Part part;
      Status status;
      fixed(ShotBall *of = balls) status =
          Native.carom_place_ball(&table, of, balls.Length, ball, x, y, &part);
      inTheWay = part;
      if (status == Status.ErrorOverlap || status == Status.ErrorOffTable)
        return false;
      Check(status);
      return true;
    }

    /// <summary>Spots a ball by the rules of a rack's game.</summary>
    public static void Spot(RackKind kind, Table table, ShotBall[] balls, int ball) {
      Calls.SpotBallOf(kind, table, balls, ball);
    }

    /// <summary>The numbers of a part, or the options of a call, as the library describes
    /// them.</summary>
    public static Row[] Rows(PartKind part) {
      var rows = new List<Row>();
      byte *range = stackalloc byte[200];
      for (Number *one; (one = Native.carom_number_of(part, rows.Count)) != null;) {
        Native.carom_number_range(one, range, (UIntPtr)200);
        rows.Add(new Row { Name = Text(one->name), Key = Text(one->key), Unit = Text(one->unit),
                           Range = Text(range), Text = Text(one->text), Low = one->low,
                           High = one->high, Other = one->other });
      }
      return rows.ToArray();
    }

    /// <summary>The word of a value, such as "han"; null if it has none.</summary>
    public static string Word(Words of, int value) {
      return Calls.Word(of, value);
    }

    /// <summary>The exception of a shot, with the invalid number if there is one.</summary>
    static CaromException Refused(Status status, Table *table, ShotBall *balls, int count, Cue *cue,
                                  ShotOptions *options) {
      Fault fault;
      byte *must = stackalloc byte[200];
      Native.carom_shot_fault(table, balls, count, cue, options, &fault, must, (UIntPtr)200);
      if (fault.row == null || must[0] == 0)
        return new CaromException(status);
      string part = fault.part.kind.ToString().ToLowerInvariant(),
             at = fault.part.kind <= PartKind.Ball || fault.part.kind == PartKind.State
                      ? $"[{fault.part.index}]"
                      : "";
      return new CaromException(
          FormattableString.Invariant(
              $"{part}{at}.{Text(fault.row->name)} must be {Text(must)}, not {fault.value}"),
          status);
    }

    /// <summary>Checks a plan; an exception names the rejected member of its job.</summary>
    internal static Status Check(Status status, PlanJob *job) {
      if (status != Status.ErrorOptions)
        return Check(status);
      byte *text = stackalloc byte[200];
      Native.carom_plan_fault(job, text, (UIntPtr)200);
      if (text[0] == 0)
        return Check(status);
      throw new CaromException(Text(text), status);
    }

    internal static ShotBall[] Copy(ShotBall *from, long count) {
      var to = new ShotBall[count];
      for (long k = 0; k < count; k++)
        to[k] = from[k];
      return to;
    }

    internal static Status Check(Status status) {
      if (status < 0)
        throw new CaromException(status);
      return status;
    }

    internal static string Text(byte *text) {
      return Marshal.PtrToStringAnsi((IntPtr)text);
    }
  }

  /// <summary>A recording, read line by line and played: docs/reference/files.md has the
  /// format.</summary>
  public sealed unsafe class Recording : IDisposable {
    Record *record;

    public Recording() {
      record = (Record *)Marshal.AllocHGlobal(sizeof(Record));
      var bytes = (byte *)record;
      for (int k = 0; k < sizeof(Record); k++)
        bytes[k] = 0;
    }

    Record *Open {
      get { return record != null ? record : throw new ObjectDisposedException("Recording"); }
    }

    /// <summary>Begins a game, and returns its lines up to the line of the balls. All lines end
    /// with an end of line.</summary>
    public string Begin(Table table, ShotBall[] balls, ShotOptions options = default(ShotOptions)) {
      if (balls.Length > Native.CAROM_BALLS_MOST)
        Billiards.Check(Status.ErrorBalls);
      *Open = new Record { table = table, options = options, count = balls.Length };
      var to = (ShotBall *)&record->balls;
      for (int k = 0; k < balls.Length; k++)
        to[k] = balls[k];
      return Line(RecordKind.Head) + Line(RecordKind.Table) + Line(RecordKind.Options) +
             Line(RecordKind.Balls);
    }

    /// <summary>Plays a stroke from where the balls are, and returns its line. The shot is Last
    /// then.</summary>
    public string Shoot(Cue cue) {
      Open->cue = cue;
      WithFault(Play(RecordKind.Shot));
      return Line(RecordKind.Shot);
    }

    /// <summary>The last shot that was played or read, with its events; for a continued shot, from
    /// its start.</summary>
    public PlayedShot Last {
      get { return last; }
    }
    PlayedShot last;

    void WithFault(Status status) {
      if (status == Status.ErrorRecord)
        throw new CaromException(status, Billiards.Text(record->fault));
      Billiards.Check(status);
    }

    Status Play(RecordKind kind) {
      var before = new[] { *Open };
      return PlayedShot.Recorded(
          record, (ShotBall *)&record->balls, ref last, kind == RecordKind.Continue,
          to => Native.carom_record_play(record, kind, to), () => *record = before[0]);
    }

    /// <summary>Puts a ball at x, y (m), at rest, and returns the line.</summary>
    public string Place(int ball, double x, double y) {
      Billiards.Check(Native.carom_record_place(Open, ball, x, y, null));
      return Line(RecordKind.Place);
    }

    /// <summary>Takes a ball in hand; it is out of play until it is placed. Returns the
    /// line.</summary>
    public string Hand(int ball) {
      Billiards.Check(Native.carom_record_hand(Open, ball));
      return Line(RecordKind.Place);
    }

    /// <summary>Ends the game, and returns its last line.</summary>
    public string End() {
      return Line(RecordKind.End);
    }

    /// <summary>The balls after the last shot.</summary>
    public ShotBall[] Layout() {
      Billiards.Check(Native.carom_record_settle(Open));
      return Billiards.Copy((ShotBall *)&record->balls, record->count);
    }

    /// <summary>The facts of the last shot, for rules.</summary>
    public Facts Facts {
      get { return Open->facts; }
    }

    string Line(RecordKind kind) {
      var line = new byte[Native.CAROM_RECORD_TEXT];
      int size;
      fixed(byte *to = line) size =
          (int)Native.carom_record_write(Open, kind, to, (UIntPtr)line.Length);
      if (size == 0)
        throw new CaromException(Status.ErrorRecord, "this line is not allowed here");
      return Encoding.ASCII.GetString(line, 0, size);
    }

    /// <summary>Reads a line, and plays its shot if it has one. Returns whether every bit is the
    /// recorded one.</summary>
    public bool Read(string line) {
      var bytes = Encoding.UTF8.GetBytes(line + "\n");
      Status status;
      fixed(byte *text = bytes) status =
          Native.carom_record_read(Open, text, (UIntPtr)bytes.Length);
      if (status < 0)
        throw new CaromException(status, Billiards.Text(record->fault));
      if ((RecordPending)record->pending != RecordPending.Shot)
        return true;
      status = Play((RecordKind)record->kind);
      if (status == Status.ErrorRecord)
        WithFault(status);
      // A shot in error is recorded with its status, so its bits count as well.
      RecordEnd played = record->played, recorded = record->recorded;
      return (long)status == played.status && played.status == recorded.status &&
             played.events == recorded.events &&
             BitConverter.DoubleToInt64Bits(played.time) ==
                 BitConverter.DoubleToInt64Bits(recorded.time) &&
             played.hash == recorded.hash;
    }

    /// <summary>Reads lines up to a shot with other bits than were recorded, and returns false
    /// there. A game that was saved without its end can be continued.</summary>
    public bool Load(string lines) {
      foreach (var line in lines.Split('\n'))
        if (!Read(line))
          return false;
      return true;
    }

    /// <summary>Shots so far.</summary>
    public long Shots {
      get { return Open->shots; }
    }
    /// <summary>The hash of all lines so far.</summary>
    public ulong Hash {
      get { return Open->hash; }
    }

    /// <summary>Whether the last line was the end; without it a recording was cut off.</summary>
    public bool Ended {
      get { return Open->kind == (long)RecordKind.End; }
    }

    public void Dispose() {
      Marshal.FreeHGlobal((IntPtr)record);
      record = null;
      GC.SuppressFinalize(this);
    }

    ~Recording() {
      Marshal.FreeHGlobal((IntPtr)record);
    }
  }
}
