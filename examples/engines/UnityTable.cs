// A match of two in Unity: put this script on an empty object, give it 16 spheres, of which the
// first is the cue ball, and press the space bar to play along the camera. The opponent thinks
// between frames. Unity's axes are (x, z, y) of carom's; sounds come from the impulses of events.
using Carom;
using UnityEngine;

public class UnityTable : MonoBehaviour {
  public Transform[] balls;
  public AudioSource click;
  public float power = 4; // m/s
  public double opponent = 550;

  LiveMatch match;
  readonly Film film = new Film();
  Thinking thinking;
  double time; // of the film, s
  int heard;   // events whose sounds were played

  void Start() {
    match = LiveMatch.Begin(RulesKind.Eightball, Billiards.Table(TableKind.Pool9ft), 5);
    Draw(match.Layout());
  }

  void OnDestroy() {
    thinking?.Dispose();
    match?.Dispose();
  }

  void Update() {
    if (match.Last != null && time < match.Last.Time)
      Show();
    else if (match.Over)
      Debug.Log(match.String());
    else if (match.Seat == 1)
      Think();
    else if (Input.GetKeyDown(KeyCode.Space))
      Shoot(Camera.main.transform.forward);
  }

  /// A frame of the last shot, and the sounds of its events.
  void Show() {
    time += Time.deltaTime;
    film.At(match.Last, time);
    for (int k = 0; k < balls.Length; k++) {
      balls[k].position = Place(film.States[k]);
      var q = film.Turned; // w, x, y, z of each ball
      balls[k].rotation = new Quaternion(-(float)q[4 * k + 1], -(float)q[4 * k + 3],
                                         -(float)q[4 * k + 2], (float)q[4 * k]);
    }
    for (; heard < match.Last.Events.Length && match.Last.Events[heard].time <= time; heard++)
      if (click != null && match.Last.Events[heard].impulse > 0)
        click.PlayOneShot(click.clip, (float)match.Last.Events[heard].impulse);
  }

  void Shoot(Vector3 along) {
    if (match.State.phase == (int)MatchPhase.Place)
      match.Place(0.635, 0.5);
    var cue = match.Cue;
    cue.speed = power;
    cue.phi = Mathf.Atan2(along.z, along.x) * Mathf.Rad2Deg;
    match.Stroke(cue);
    time = heard = 0;
  }

  /// A slice of the opponent's plan; its stroke once it has ended.
  void Think() {
    if (thinking == null)
      thinking = match.Position(match.Cue, opponent).Think(500);
    if (!thinking.GoOn())
      return;
    var best = thinking.Choices[0];
    thinking.Dispose();
    thinking = null;
    match.Take(best, best.cue);
    time = heard = 0;
  }

  static Vector3 Place(BallState ball) {
    return new Vector3((float)ball.r[0], (float)ball.r[2], (float)ball.r[1]);
  }

  void Draw(ShotBall[] layout) {
    for (int k = 0; k < balls.Length; k++)
      balls[k].position = Place(layout[k].state);
  }
}
