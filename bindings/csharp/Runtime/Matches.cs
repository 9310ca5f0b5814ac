// Matches: one object that knows the rules, and writes its recording.
using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Carom {
  /// <summary>A match, as carom_match.h has it. An act that the rules forbid is a CaromException
  /// that says what would be right; then nothing has changed.</summary>
  public sealed unsafe class LiveMatch : IDisposable {
    Match *match;
    Record *scratch;

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

    Status Told(Status status) {
      if (status < 0 && match->fault[0] != 0)
        throw new CaromException(status, Marshal.PtrToStringAnsi((IntPtr)match->fault));
      return Billiards.Check(status);
    }

    /// <summary>Begins a match with the rack of a game; `player`, 0 or 1, breaks.</summary>
    public static LiveMatch Begin(RulesKind rules, Table table, ulong seed, int player = 0) {
      var made = new LiveMatch();
      made.Told(Native.carom_match_begin(made.match, rules, &table, seed, player));
      return made;
    }

    /// <summary>Reads and judges the lines of a match. Lines has those that the text
    /// lacks.</summary>
    public static LiveMatch Load(string lines) {
      var made = new LiveMatch();
      foreach (var line in lines.Split(new[] { '\n' }, StringSplitOptions.RemoveEmptyEntries)) {
        var bytes = Encoding.ASCII.GetBytes(line);
        fixed(byte *at = bytes)
            made.Told(Native.carom_match_read(made.match, made.scratch, at, (UIntPtr)bytes.Length));
      }
      return made;
    }

    /// <summary>All that is known of the match: its phase, choices, bounds and record.</summary>
    public Match State {
      get { return *Open; }
    }
    /// <summary>Who is at the table, 0 or 1.</summary>
    public int Player {
      get { return (int)Open->record.player; }
    }
    /// <summary>0 or 1; -1: nobody has won yet.</summary>
    public int Winner {
      get { return Open->winner; }
    }
    /// <summary>Whether the match is over.</summary>
    public bool Over {
      get { return Open->phase == (int)MatchPhase.Over; }
    }
    /// <summary>The lines of the last act.</summary>
    public string Lines {
      get { return Marshal.PtrToStringAnsi((IntPtr)Open->text, (int)match->size); }
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
      if (match->phase == (int)MatchPhase.Place)
        of.Bounds = match->bounds;
      return of;
    }

    /// <summary>Makes one of the choices that the rules allow now.</summary>
    public void Choose(May choice) {
      Told(Native.carom_match_choose(Open, Player, choice));
    }
    /// <summary>Puts the cue ball in hand at a place, m, within the bounds.</summary>
    public void Place(double x, double y) {
      Told(Native.carom_match_place(Open, Player, x, y));
    }
    /// <summary>Ball -1: a safety.</summary>
    public void Call(int ball, int pocket) {
      Told(Native.carom_match_call(Open, Player, new Call { ball = ball, pocket = pocket }));
    }
    /// <summary>Plays a stroke; `stop` says when to stop its shot. Returns whether the shot has
    /// ended, and is ruled.</summary>
    public bool Stroke(Cue cue, ShotOptions stop = default(ShotOptions)) {
      Cue *by = &cue;
      ShotOptions *until = &stop;
      return Play(false, to => Native.carom_match_stroke(match, Player, by, until, to));
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
    /// <summary>The time of the player at the table is over.</summary>
    public void Clock() {
      Told(Native.carom_match_clock(Open, Player));
    }
    /// <summary>Ends the recording.</summary>
    public void End() {
      Told(Native.carom_match_end(Open));
    }

    /// <summary>Takes a choice of a plan: places, calls and plays its stroke, or passes. `cue` is
    /// the stroke as the player makes it. Returns the lines of all these acts.</summary>
    public string Take(Choice best, Cue cue) {
      var all = new StringBuilder();
      if (Open->phase == (int)MatchPhase.Place) {
        Place(best.place[0], best.place[1]);
        all.Append(Lines);
      }
      if (best.kind == (int)PlanKind.Pass) {
        Choose(May.Pass);
        return all.Append(Lines).ToString();
      }
      if (best.kind == (int)PlanKind.Push) {
        Choose(May.Push);
        all.Append(Lines);
      }
      if (match->rules.calls != 0 && best.ball >= 0) {
        Call(best.ball, best.pocket);
        all.Append(Lines);
      }
      Stroke(cue);
      return all.Append(Lines).ToString();
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
