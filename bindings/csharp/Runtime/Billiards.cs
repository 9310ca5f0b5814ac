// Tables, racks, shots and recordings without pointers. Native has every other function of the library.
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using System.Text;

namespace Carom {
  /// <summary>A call that could not be served.</summary>
  public sealed class CaromException : Exception {
    public readonly Status Status;

    internal CaromException(string fault, Status status) : base(fault) { Status = status; }

    internal unsafe CaromException(Status status, string more = null)
        : base(Billiards.Text(Native.carom_status_string(status)) + (more == null ? "" : ": " + more)) {
      Status = status;
    }
  }

  /// <summary>A shot that was played.</summary>
  public sealed unsafe class PlayedShot {
    /// <summary>Ok; or StoppedAtTime or StoppedAtEvent, as the options ask.</summary>
    public Status Status { get; internal set; }
    /// <summary>All events, in the order in which they happened.</summary>
    public Event[] Events { get; internal set; }
    /// <summary>The states at the end, one for each ball.</summary>
    public BallState[] Final { get; internal set; }
    /// <summary>Up to when the shot was followed, s.</summary>
    public double Time { get; internal set; }
    /// <summary>What rules ask about.</summary>
    public Facts Facts { get; internal set; }
    internal ShotBall[] balls;

    /// <summary>The layout that it leaves.</summary>
    public ShotBall[] Layout() {
      var layout = (ShotBall[])balls.Clone();
      for (int k = 0; k < layout.Length; k++) layout[k].state = Final[k];
      return layout;
    }

    /// <summary>The states at a time for drawing, s: pocketed balls fall in their pockets.</summary>
    public BallState[] Drawn(Table table, double time) {
      var states = new BallState[balls.Length];
      fixed (ShotBall* of = balls)
      fixed (Event* events = Events)
      fixed (BallState* to = states) {
        var shot = Data(events);
        Billiards.Check(Native.carom_shot_drawn(&table, of, balls.Length, &shot, &time, (UIntPtr)1, to));
      }
      return states;
    }

    /// <summary>What the library reads of it.</summary>
    internal Shot Data(Event* events) { return new Shot { events = events, room = Events.Length, count = Events.Length, time = Time }; }

    /// <summary>The states of all balls at a time, s.</summary>
    public BallState[] At(double time) {
      var states = new BallState[balls.Length];
      fixed (ShotBall* of = balls)
      fixed (Event* events = Events)
      fixed (BallState* to = states) {
        var shot = Data(events);
        Billiards.Check(Native.carom_shot_at(of, balls.Length, &shot, time, to));
      }
      return states;
    }
  }

  /// <summary>A film of shots, for drawing: each frame goes on from the one before, where that was of the same shot and earlier.</summary>
  public sealed unsafe class Film {
    readonly Frames[] onward = new Frames[1];

    /// <summary>The states of all balls at the time of the last call. The next one writes into the same array.</summary>
    public BallState[] States { get; private set; }
    /// <summary>How they have turned since the start of the shot: w, x, y, z of each, one behind the other.</summary>
    public double[] Turned { get; private set; }

    /// <summary>Goes to a time of a shot, s.</summary>
    public void At(PlayedShot shot, double time) {
      int count = shot.balls.Length;
      if (States == null || States.Length != count) {
        States = new BallState[count];
        Turned = new double[4 * count];
      }
      fixed (ShotBall* balls = shot.balls)
      fixed (Event* events = shot.Events)
      fixed (Frames* film = onward)
      fixed (BallState* states = States)
      fixed (double* turned = Turned) {
        var data = shot.Data(events);
        Billiards.Check(Native.carom_shot_frames(balls, count, &data, &time, (UIntPtr)1, film, states, turned));
      }
    }
  }

  /// <summary>A number of a ball, a cue or a table, or an option: its names, unit, range in words, default, and what it is.</summary>
  public sealed class Row {
    public string Name, Key, Unit, Range, Text;
    public double Low, High, Other;
  }

  /// <summary>What the library offers to a game.</summary>
  public static unsafe class Billiards {
    /// <summary>The revision of the physics: players in lockstep agree only with the same number.</summary>
    public static int PhysicsRevision { get { return Native.carom_physics_revision(); } }

    /// <summary>The version of the library that runs.</summary>
    public static string Version { get { return Text(Native.carom_version()); } }

    /// <summary>A built-in table.</summary>
    public static Table Table(TableKind kind) {
      Table table;
      Check(Native.carom_table_make(kind, &table));
      return table;
    }

    /// <summary>A rack, with the cue ball first. `gap`, m, is left between neighbours; `seed` draws the rest.</summary>
    public static ShotBall[] Rack(RackKind kind, Table table, double gap = 1e-4, ulong seed = 1) {
      var balls = new ShotBall[Native.carom_rack_size(kind)];
      fixed (ShotBall* to = balls) Check(Native.carom_rack(kind, &table, gap, seed, to, balls.Length));
      return balls;
    }

    /// <summary>The usual cue of a game.</summary>
    public static Cue Cue(Game game) { return Native.carom_cue_of(game); }

    /// <summary>Plays a shot until nothing moves, or until the options stop it. The balls are not changed.</summary>
    public static PlayedShot Play(Table table, ShotBall[] balls, Cue cue, ShotOptions options = default(ShotOptions)) {
      var shot = new PlayedShot { Final = new BallState[balls.Length], balls = (ShotBall[])balls.Clone() };
      // Most shots have fewer events; one with more is played again with room for all of them.
      for (long room = 256;;) {
        var events = new Event[room];
        Facts facts;
        var data = new Shot { room = room, facts = &facts };
        fixed (ShotBall* of = balls)
        fixed (BallState* final = shot.Final)
        fixed (Event* to = events) {
          data.events = to;
          data.final = final;
          shot.Status = Native.carom_shoot(&table, of, balls.Length, &cue, &options, &data);
          if (shot.Status < 0) throw Refused(shot.Status, &table, of, balls.Length, &cue, &options);
        }
        if (data.count <= room) {
          Array.Resize(ref events, (int)data.count);
          shot.Events = events;
          shot.Time = data.time;
          shot.Facts = facts;
          return shot;
        }
        room = data.count;
      }
    }

    /// <summary>Ball in hand: puts a ball at rest at x, y (m). False where that place is not free; `inTheWay` is what is there, and the ball stays.</summary>
    public static bool Place(Table table, ShotBall[] balls, int ball, double x, double y, out Part inTheWay) {
      Part part;
      Status status;
      fixed (ShotBall* of = balls) status = Native.carom_place_ball(&table, of, balls.Length, ball, x, y, &part);
      inTheWay = part;
      if (status == Status.ErrorOverlap || status == Status.ErrorOffTable) return false;
      Check(status);
      return true;
    }

    /// <summary>The numbers of a part, or the options of a call, as the library describes them.</summary>
    public static Row[] Rows(PartKind part) {
      var rows = new List<Row>();
      byte* range = stackalloc byte[200];
      for (Number* one; (one = Native.carom_number_of(part, rows.Count)) != null;) {
        Native.carom_number_range(one, range, (UIntPtr)200);
        rows.Add(new Row { Name = Text(one->name), Key = Text(one->key), Unit = Text(one->unit), Range = Text(range), Text = Text(one->text),
                           Low = one->low, High = one->high, Other = one->other });
      }
      return rows.ToArray();
    }

    /// <summary>The word of a value, such as "han"; null where it has none.</summary>
    public static string Word(Words of, int value) { return Text(Native.carom_word(of, value)); }

    /// <summary>The exception of a shot, with the number at fault where there is one.</summary>
    static CaromException Refused(Status status, Table* table, ShotBall* balls, int count, Cue* cue, ShotOptions* options) {
      Fault fault;
      byte* must = stackalloc byte[200];
      Native.carom_shot_fault(table, balls, count, cue, options, &fault, must, (UIntPtr)200);
      if (fault.row == null || must[0] == 0) return new CaromException(status);
      string part = fault.part.kind.ToString().ToLowerInvariant(), at = fault.part.kind <= PartKind.Ball || fault.part.kind == PartKind.State ? $"[{fault.part.index}]" : "";
      return new CaromException(FormattableString.Invariant($"{part}{at}.{Text(fault.row->name)} must be {Text(must)}, not {fault.value}"), status);
    }

    internal static Status Check(Status status) {
      if (status < 0) throw new CaromException(status);
      return status;
    }

    internal static string Text(byte* text) { return Marshal.PtrToStringAnsi((IntPtr)text); }
  }

  /// <summary>A recording, read line by line and played: docs/using/games.md has the format.</summary>
  public sealed unsafe class Recording : IDisposable {
    Record* record;

    public Recording() {
      record = (Record*)Marshal.AllocHGlobal(sizeof(Record));
      var bytes = (byte*)record;
      for (int k = 0; k < sizeof(Record); k++) bytes[k] = 0;
    }

    /// <summary>Reads a line, and plays its shot if it has one. Returns whether every bit is the recorded one.</summary>
    public bool Read(string line) {
      if (record == null) throw new ObjectDisposedException("Recording");
      var bytes = Encoding.UTF8.GetBytes(line + "\n");
      Status status;
      fixed (byte* text = bytes) status = Native.carom_record_read(record, text, (UIntPtr)bytes.Length);
      if (status < 0) throw new CaromException(status, Billiards.Text(record->fault));
      if (record->pending != 1) return true;
      status = Native.carom_record_play(record, (RecordKind)record->kind, null);
      // A shot in error is recorded with its status, so its bits count as well.
      RecordEnd played = record->played, recorded = record->recorded;
      return (long)status == played.status && played.status == recorded.status && played.events == recorded.events &&
             BitConverter.DoubleToInt64Bits(played.time) == BitConverter.DoubleToInt64Bits(recorded.time) && played.hash == recorded.hash;
    }

    /// <summary>Shots so far, and the hash of all lines so far.</summary>
    public long Shots { get { return record->shots; } }
    public ulong Hash { get { return record->hash; } }

    /// <summary>Whether the last line was the end; without it a recording was cut off.</summary>
    public bool Ended { get { return record->kind == (long)RecordKind.End; } }

    public void Dispose() {
      Marshal.FreeHGlobal((IntPtr)record);
      record = null;
      GC.SuppressFinalize(this);
    }

    ~Recording() { Marshal.FreeHGlobal((IntPtr)record); }
  }
}
