// Matches: one object that knows the rules, and writes its recording.
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using System.Text;

namespace Carom {
  /// <summary>A match of carom_match.h. An act that the rules forbid throws a CaromException that
  /// describes what would be right, and changes nothing.</summary>
  public sealed unsafe partial class LiveMatch : IDisposable {
    Match *match;
    Record *scratch;
    Match *room;
    readonly StringBuilder lines = new StringBuilder();
    readonly Stack<string> undone = new Stack<string>();

    LiveMatch() {
      match = (Match *)Zeros(sizeof(Match));
      scratch = (Record *)Zeros(sizeof(Record));
      room = (Match *)Zeros(sizeof(Match));
    }

    static IntPtr Zeros(int size) {
      var made = Marshal.AllocHGlobal(size);
      Marshal.Copy(new byte[size], 0, made, size);
      return made;
    }

    Match *Open {
      get { return match != null ? match : throw new ObjectDisposedException("LiveMatch"); }
    }

    string Text() {
      return Encoding.UTF8.GetString(match->text, (int)match->size);
    }
    /// Keeps the lines of an act; throws an exception for a rejected act.
    Status Told(Status status) {
      if (status < 0 && match->size == 0)
        return Refused(status);
      KeepLines(); // also those of Prepare() before an act that is refused
      undone.Clear();
      return Judged(status);
    }
    /// Adds the lines that the match has made.
    void KeepLines() {
      lines.Append(Text());
      KeepSizes();
    }
    /// How many bytes of match->text are what: a refused act changes these members, and not the
    /// bytes.
    long size, known, due;
    void KeepSizes() {
      size = match->size;
      known = match->known;
      due = match->due;
    }
    /// The result of a line or of an act that was perhaps refused; the lines that are due stay due.
    Status Refused(Status status) {
      if (status < 0) {
        match->size = size;
        match->known = known;
        match->due = due;
      }
      return Judged(status);
    }
    Status Judged(Status status) {
      if (status < 0 && match->fault[0] != 0)
        throw new CaromException(status, Marshal.PtrToStringAnsi((IntPtr)match->fault));
      return Billiards.Check(status);
    }

    /// <summary>Begins a match with the rack of a game; `side` 0 or 1 breaks. `target` points
    /// win, 0: the usual target of the game; with `equalInnings` the match may be drawn.</summary>
    public static LiveMatch Begin(RulesKind rules, Table table, ulong seed, int side = 0,
                                  int target = 0, bool equalInnings = false) {
      var setup =
          new MatchSetup { rules = rules, table = &table,  seed = seed,
                           side = side,   target = target, equalInnings = equalInnings ? 1 : 0 };
      return Begin(&setup);
    }

    /// <summary>The same from any layout, by the rules of this kind; the cue ball is in hand if
    /// `leave` says so.</summary>
    public static LiveMatch Begin(RulesKind rules, Table table, ShotBall[] balls,
                                  Leave leave = Leave.After, int side = 0) {
      fixed(ShotBall *at = balls) {
        var setup = new MatchSetup { rules = rules,        table = &table, balls = at,
                                     count = balls.Length, leave = leave,  side = side };
        return Begin(&setup);
      }
    }

    /// <summary>The same with any seats, which carom_seating_make() initializes: names, sides,
    /// handicaps, cues and limits; and optionally with a set.</summary>
    public static LiveMatch Begin(RulesKind rules, Table table, ulong seed, Seating seating,
                                  Set? set = null, int side = 0, int target = 0,
                                  bool equalInnings = false) {
      var of = set ?? default(Set);
      var setup = new MatchSetup { rules = rules,
                                   table = &table,
                                   seed = seed,
                                   seating = &seating,
                                   side = side,
                                   target = target,
                                   set = set == null ? null : &of,
                                   equalInnings = equalInnings ? 1 : 0 };
      return Begin(&setup);
    }
    static LiveMatch Begin(MatchSetup *setup) {
      var made = new LiveMatch();
      made.Told(Native.carom_match_begin_with(made.match, setup));
      return made;
    }

    /// <summary>Reads and judges the lines of a match. The last shot has all its events, also if
    /// balls are still moving.</summary>
    public static LiveMatch Load(string lines) {
      if (lines.Length == 0)
        throw new CaromException(Status.ErrorRecord,
                                 "the text is empty: a match begins with a recording line");
      var made = new LiveMatch();
      made.ReadAll(lines);
      return made;
    }
    void ReadAll(string text) {
      *match = default(Match);
      lines.Clear();
      KeepSizes();
      foreach (var line in text.Split(new[] { '\n' }, StringSplitOptions.RemoveEmptyEntries))
        ReadLine(line);
      Replay();
    }
    /// Reads a line of a file. `lines` has the lines that are still due already, at its end, and a
    /// note comes before them.
    void ReadLine(string line) {
      var lineCount = Open->record.line;
      var hash = match->record.hash;
      int awaited = match->due > 0 ? Text().Length : 0;
      var bytes = Encoding.UTF8.GetBytes(line + "\n");
      fixed(byte *at = bytes)
          Refused(Native.carom_match_read(match, scratch, at, (UIntPtr)bytes.Length));

      // no blank line, no event, and none that was due
      bool isNew = match->record.line != lineCount || match->record.hash != hash;
      if (isNew)
        lines.Insert(lines.Length - awaited, line.TrimEnd() + "\n");
      if (isNew && awaited == 0)
        KeepLines();
      else
        KeepSizes();
    }

    /// <summary>Reads the next line of a file. Nothing is read behind a line that is not by the
    /// rules.</summary>
    public void Read(string line) {
      var shots = Shots;
      ReadLine(line);
      undone.Clear();
      if (Shots != shots)
        Replay();
    }

    /// <summary>Judges a line that a peer of this seat has sent, as carom_match_receive() does;
    /// null: a sender that may send every line. A line that is refused, with a CaromException,
    /// leaves the match as it was. Returns whether the match has changed; Lines then has new
    /// ones.</summary>
    public bool Receive(string line, int? seat) {
      var shots = Shots;
      var lineCount = Open->record.line;
      var bytes = Encoding.UTF8.GetBytes(line + "\n");
      fixed(byte *at = bytes)
          Refused(Native.carom_match_receive(match, room, at, (UIntPtr)bytes.Length, seat ?? -1));
      if (match->record.line == lineCount)
        return false;
      undone.Clear();
      if (match->size == 0) // a line of the beginning, which is read and not made
        lines.Append(line.TrimEnd() + "\n");
      KeepLines();
      if (Shots != shots)
        Replay();
      return true;
    }

    /// <summary>Undoes the last act. False: there is none.</summary>
    public bool Undo() {
      var bytes = Encoding.UTF8.GetBytes(Lines);
      int size;
      fixed(byte *at = bytes) size = (int)Native.carom_match_undone(at, (UIntPtr)bytes.Length);
      if (Open->phase == 0 || size == bytes.Length)
        return false;
      undone.Push(Encoding.UTF8.GetString(bytes, size, bytes.Length - size));
      ReadAll(Encoding.UTF8.GetString(bytes, 0, size));
      return true;
    }
    /// <summary>Repeats the act that was undone last. False: there is nothing to repeat.</summary>
    public bool Redo() {
      if (Open->phase == 0 || undone.Count == 0)
        return false;
      ReadAll(Lines + undone.Pop());
      return true;
    }
    /// <summary>A copy of the match, independent of this one.</summary>
    public LiveMatch Copy() {
      var made = new LiveMatch();
      *made.match = *Open;
      made.lines.Append(Lines);
      made.KeepSizes();
      made.Replay();
      return made;
    }

    /// <summary>The complete state of the match: phase, choices, bounds and record.</summary>
    public Match State {
      get { return *Open; }
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

    /// <summary>The balls; while a shot is moving, the balls before it.</summary>
    public ShotBall[] Layout() {
      return Billiards.Copy((ShotBall *)&Open->record.balls, match->record.count);
    }

    /// <summary>The text of the last ruling.</summary>
    public string Words {
      get { return Billiards.Words(ref Open->ruling); }
    }
    /// <summary>The last shot, with all its events.</summary>
    public PlayedShot Last {
      get { return last; }
    }
    PlayedShot last;

    /// <summary>The position of the player at the table, for plans of a player with a rating; in
    /// hand, with the bounds of the match.</summary>
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

    /// <summary>Plays a stroke; `stop` sets when its shot is stopped. Returns whether the shot has
    /// ended, and was judged.</summary>
    public bool Stroke(Cue cue, ShotOptions stop = default(ShotOptions)) {
      Cue *by = &cue;
      ShotOptions *until = &stop;
      return Play(false, to => Native.carom_match_stroke(match, Seat, by, until, to));
    }
    /// <summary>Continues a stopped shot in the same way.</summary>
    public bool GoOn(ShotOptions stop = default(ShotOptions)) {
      ShotOptions *until = &stop;
      return Play(true, to => Native.carom_match_continue(match, until, to));
    }
    bool Play(bool goesOn, PlayedShot.Playing once) {
      var before = new[] { *Open };
      var status = PlayedShot.Recorded(&match->record, (ShotBall *)&match->record.balls, ref last,
                                       goesOn, once, () => *match = before[0]);
      return Told(status) == Status.Ok;
    }
    /// The last shot of a match that was read, with all its events.
    void Replay() {
      last = null;
      if (match->stroke.mass > 0)
        PlayedShot.Recorded(&match->record, (ShotBall *)&match->before, ref last, false,
                            to => Native.carom_match_replay(match, to), () => {});
    }
    /// <summary>A seat concedes the game.</summary>
    public void Concede(int seat) {
      Told(Native.carom_match_concede(Open, seat));
    }
    /// <summary>Writes words into the recording: texts by their keys, such as "comment", and the
    /// time in s that the last stroke took the player, 0: none. docs/reference/files.md has the
    /// keys; those of a caller begin with "x_". `seat` is who says it; null: nobody in particular.
    /// The game and its hashes do not change.</summary>
    public void Note(int? seat, Dictionary<string, string> said, double seconds = 0) {
      var line = new StringBuilder("{\"note\":{");
      string comma = "";
      foreach (var pair in said) {
        var text = pair.Value.Replace("\\", "\\\\").Replace("\"", "\\\"");
        line.Append(comma).Append('"').Append(pair.Key).Append("\":\"").Append(text).Append('"');
        comma = ",";
      }
      line.Append("}}");

      // The library reads the texts, as it would those of a file.
      *scratch = Open->record;
      scratch->note = default(Note);
      var bytes = Encoding.UTF8.GetBytes(line.ToString());
      var status = Status.Ok;
      if (said.Count > 0)
        fixed(byte *at = bytes) status =
            Native.carom_record_read(scratch, at, (UIntPtr)bytes.Length);
      if (status < 0)
        throw new CaromException(status, Marshal.PtrToStringAnsi((IntPtr)scratch->fault));
      scratch->note.seconds = seconds;
      Told(Native.carom_match_note(match, seat ?? -1, &scratch->note));
    }
    /// <summary>The lines of the notes of the recording so far, which it does not seal.</summary>
    public List<string> Notes {
      get {
        var notes = new List<string>();
        foreach (var line in Lines.Split('\n'))
          if (line.TrimStart(' ', '{').StartsWith("\"note\"", StringComparison.Ordinal))
            notes.Add(line);
        return notes;
      }
    }
    /// <summary>Plays a choice of a plan: places, calls and plays its stroke, or passes. `cue` is
    /// the stroke as the player makes it; `stop` as for a stroke.</summary>
    public void Take(PlanStroke best, Cue cue, ShotOptions stop = default(ShotOptions)) {
      Prepare(best);
      if (best.kind != (int)PlanKind.Pass)
        Stroke(cue, stop);
    }

    public void Dispose() {
      Marshal.FreeHGlobal((IntPtr)match);
      Marshal.FreeHGlobal((IntPtr)scratch);
      Marshal.FreeHGlobal((IntPtr)room);
      match = null;
      scratch = null;
      room = null;
      GC.SuppressFinalize(this);
    }
    ~LiveMatch() {
      Dispose();
    }
  }
}
