// Matches: one object that knows the rules, and writes its recording.
using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Carom {
  /// <summary>A match, as carom_match.h has it. An act that the rules forbid is a CaromException
  /// that says what would be right; then nothing has changed.</summary>
  public sealed unsafe partial class LiveMatch : IDisposable {
    Match *match;
    Record *scratch;
    readonly StringBuilder lines = new StringBuilder();

    LiveMatch() {
      match = (Match *)Zeros(sizeof(Match));
      scratch = (Record *)Zeros(sizeof(Record));
    }

    static IntPtr Zeros(int size) {
      var made = Marshal.AllocHGlobal(size);
      Marshal.Copy(new byte[size], 0, made, size);
      return made;
    }

    Match *Open {
      get { return match != null ? match : throw new ObjectDisposedException("LiveMatch"); }
    }

    /// Keeps the lines of an act; throws what was refused.
    Status Told(Status status) {
      lines.Append(Marshal.PtrToStringAnsi((IntPtr)match->text, (int)match->size));
      return Refused(status);
    }
    Status Refused(Status status) {
      if (status < 0 && match->fault[0] != 0)
        throw new CaromException(status, Marshal.PtrToStringAnsi((IntPtr)match->fault));
      return Billiards.Check(status);
    }

    /// <summary>Begins a match with the rack of a game; `player`, 0 or 1, breaks. `target` points
    /// win, 0: those of the game; with `equalInnings` the match may be drawn.</summary>
    public static LiveMatch Begin(RulesKind rules, Table table, ulong seed, int player = 0,
                                  int target = 0, bool equalInnings = false) {
      var made = new LiveMatch();
      made.Told(Native.carom_match_begin_to(made.match, rules, target, equalInnings ? 1 : 0, &table,
                                            seed, player));
      return made;
    }

    /// <summary>The same from any layout, by the rules of this kind; the cue ball is in hand where
    /// `leave` says so.</summary>
    public static LiveMatch Begin(RulesKind rules, Table table, ShotBall[] balls,
                                  Leave leave = Leave.After, int player = 0) {
      var made = new LiveMatch();
      fixed(ShotBall *at = balls) made.Told(Native.carom_match_begin_at(
          made.match, rules, null, &table, at, balls.Length, null, leave, player));
      return made;
    }

    /// <summary>Reads and judges the lines of a match.</summary>
    public static LiveMatch Load(string lines) {
      var made = new LiveMatch();
      foreach (var line in lines.Split(new[] { '\n' }, StringSplitOptions.RemoveEmptyEntries)) {
        var bytes = Encoding.ASCII.GetBytes(line);
        fixed(byte *at = bytes) made.Refused(
            Native.carom_match_read(made.match, made.scratch, at, (UIntPtr)bytes.Length));
        made.lines.Append(line).Append('\n');
      }
      made.Told(Status.Ok);
      return made;
    }

    /// <summary>All that is known of the match: its phase, choices, bounds and record.</summary>
    public Match State {
      get { return *Open; }
    }
    /// <summary>The side at the table, 0 or 1; in games that each plays for itself, the seat.</summary>
    public int Player {
      get { return (int)Open->record.player; }
    }
    /// <summary>The seat at the table.</summary>
    public int Seat {
      get { return Open->seat; }
    }
    /// <summary>The side that has won; -1: none.</summary>
    public int Winner {
      get { return Drawn ? -1 : Open->winner - 1; }
    }
    /// <summary>Whether the match is over without a winner.</summary>
    public bool Drawn {
      get { return Open->winner == Native.CAROM_DRAWN; }
    }
    /// <summary>How many strokes were played.</summary>
    public long Shots {
      get { return Open->record.shots; }
    }
    /// <summary>Whether the match is over.</summary>
    public bool Over {
      get { return Open->phase == (int)MatchPhase.Over; }
    }
    /// <summary>The recording so far, with the lines that were missing in a text that was read and
    /// cut off.</summary>
    public string Lines {
      get { return lines.ToString(); }
    }
    /// <summary>The last ruling.</summary>
    public Ruling Ruling {
      get { return Open->ruling; }
    }

    /// <summary>The last ruling in words.</summary>
    public string Words {
      get { return Billiards.Words(ref Open->ruling); }
    }
    /// <summary>The last shot, with all its events.</summary>
    public PlayedShot Last {
      get { return last; }
    }
    PlayedShot last;

    /// <summary>The position of the player at the table, of a rating, for plans; in hand, with the
    /// bounds of the match.</summary>
    public Position Position(Cue cue, double rating) {
      cue.ball = Open->cueBall;
      var balls = Billiards.Copy((ShotBall *)&match->record.balls, match->record.count);
      var of = new Position(match->record.table, balls, cue, match->rules, rating);
      of.Shot = match->record.options;
      of.Leave = (Leave)match->leave;
      if (match->phase == (int)MatchPhase.Place)
        of.Bounds = match->bounds;
      return of;
    }

    /// <summary>Plays a stroke; `stop` says when to stop its shot. Returns whether the shot has
    /// ended, and is ruled.</summary>
    public bool Stroke(Cue cue, ShotOptions stop = default(ShotOptions)) {
      Cue *by = &cue;
      ShotOptions *until = &stop;
      return Play(false, to => Native.carom_match_stroke(match, Seat, by, until, to));
    }
    /// <summary>Goes on with a stopped shot, likewise.</summary>
    public bool GoOn(ShotOptions stop = default(ShotOptions)) {
      ShotOptions *until = &stop;
      return Play(true, to => Native.carom_match_continue(match, until, to));
    }
    bool Play(bool goesOn, PlayedShot.Playing once) {
      var before = new[] { *Open };
      var status =
          PlayedShot.Recorded(&match->record, ref last, goesOn, once, () => *match = before[0]);
      return Told(status) == Status.Ok;
    }
    /// <summary>A player, 0 or 1, gives the game to the other.</summary>
    public void Concede(int player) {
      Told(Native.carom_match_concede(Open, player));
    }
    /// <summary>Takes a choice of a plan: places, calls and plays its stroke, or passes. `cue` is
    /// the stroke as the player makes it.</summary>
    public void Take(PlanStroke best, Cue cue) {
      Prepare(best);
      if (best.kind != (int)PlanKind.Pass)
        Stroke(cue);
    }

    public void Dispose() {
      Marshal.FreeHGlobal((IntPtr)match);
      Marshal.FreeHGlobal((IntPtr)scratch);
      match = null;
      scratch = null;
      GC.SuppressFinalize(this);
    }
    ~LiveMatch() {
      Dispose();
    }
  }
}
