// A network match in Godot 4 (C#): a scene with balls as children of this node, the cue ball first.
// Each client plays its own seat, sends the lines of its acts to the others, and reads theirs by
// sender: the match refuses what a seat may not do. Godot's axes are (x, z, -y) of carom's.
using Carom;
using Godot;

public partial class GodotTable : Node3D {
  [Export]
  public int Seat;
  [Export]
  public double Power = 4; // m/s

  [Signal]
  public delegate void SentEventHandler(string line);
  [Signal]
  public delegate void CheatedEventHandler(string words);

  LiveMatch match;
  readonly Film film = new Film();
  double time;

  public override void _Ready() {
    var seating = Calls.SeatingMake(RulesKind.Nineball, 4); // two pairs
    seating.alternate = 1;                                  // partners play stroke by stroke
    match = LiveMatch.Begin(RulesKind.Nineball, Billiards.Table(TableKind.Pool9ft), 7, seating);
    Draw(match.Layout());
  }

  public override void _ExitTree() {
    match.Dispose();
  }

  public override void _Process(double delta) {
    if (match.Last == null || time >= match.Last.Time)
      return;
    time += delta;
    film.At(match.Last, time);
    for (int k = 0; k < film.States.Length; k++) {
      var ball = GetChild<Node3D>(k);
      var q = film.Turned; // w, x, y, z of each ball
      ball.Position = Place(film.States[k]);
      ball.Quaternion = new Quaternion((float)q[4 * k + 1], (float)q[4 * k + 3],
                                       -(float)q[4 * k + 2], (float)q[4 * k]);
    }
  }

  /// A stroke of this seat along an angle, radians around Godot's y axis.
  public void Shoot(double angle) {
    if (match.Seat != Seat || match.Over)
      return;
    int known = match.Lines.Length;
    if (match.State.phase == (int)MatchPhase.Place)
      match.Place(0.635, 0.5);
    var cue = match.Cue;
    cue.speed = Power;
    cue.phi = angle * 180 / System.Math.PI;
    match.Stroke(cue);
    time = 0;
    foreach (var line in match.Lines.Substring(known).Split('\n'))
      if (line != "")
        EmitSignal(SignalName.Sent, line);
  }

  /// A line that another seat has sent.
  public void Receive(string line, int sender) {
    long shots = match.Shots;
    try {
      match.Receive(line, sender);
    } catch (CaromException refused) {
      EmitSignal(SignalName.Cheated, refused.Message);
    }
    if (match.Shots != shots)
      time = 0;
  }

  static Vector3 Place(BallState ball) {
    return new Vector3((float)ball.r[0], (float)ball.r[2], -(float)ball.r[1]);
  }

  void Draw(ShotBall[] layout) {
    for (int k = 0; k < layout.Length; k++)
      GetChild<Node3D>(k).Position = Place(layout[k].state);
  }
}
