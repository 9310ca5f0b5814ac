/* Shots that play. The places are those of carom_shot_at() at equal steps and at every event, so
 * that between two of them a straight line does, and no contact is cut short. */
#include "animate.h"

#include "memory.h"
#include "message.h"
#include "shot_words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double step = 1.0 / 40.0; /* s */

OPTION_SET(set_animation) {
  const size_t size = strlen(text);
  *(const char **)field = text;
  if (size > 5 && strcmp(text + size - 5, ".html") == 0)
    return true;
  complain("--%s writes a page whose name ends in .html, not '%s'", row->name, text);
  return false;
}

/* The times of a shot's frames in order, to be freed. */
static double *frames_of(const carom_shot *shot, size_t *count) {
  const int64_t events = shot->count < shot->room ? shot->count : shot->room;
  const size_t steps = (size_t)ceil(shot->time / step) + 1;
  double *at = allocate(steps + (size_t)events, sizeof *at);
  int64_t next = 0;
  *count = 0;
  for (size_t k = 0; k < steps; k++) {
    const double time = fmin((double)k * step, shot->time);
    for (; next < events && shot->events[next].time <= time; next++)
      if (*count == 0 || shot->events[next].time > at[*count - 1])
        at[(*count)++] = shot->events[next].time;
    if (*count == 0 || time > at[*count - 1])
      at[(*count)++] = time;
  }
  return at;
}

/* [[times], [[x, y, ...] of each ball that is drawn]] */
static void write_frames(FILE *out, const played *p, int index) {
  size_t frames;
  double *at = frames_of(p->shot, &frames);
  carom_ball_state states[CAROM_BALLS_MOST];
  const char *between = "";
  fputs("[[", out);
  for (size_t k = 0; k < frames; k++)
    fprintf(out, "%s%.4f", k > 0 ? "," : "", at[k]);
  fputs("],[", out);
  for (int ball = 0; ball < p->line->count; ball++) {
    if (!shot_shows(p, index, ball))
      continue;
    fprintf(out, "%s[", between);
    between = ",\n";
    /* A ball that lies still has one place. */
    for (size_t k = 0; k < (ball_moved(p->shot, ball) ? frames : 1); k++) {
      double place[2];
      carom_shot_at(p->line->ball, p->line->count, p->shot, at[k], states);
      shot_place(&p->line->table->table, states[ball].r, place);
      fprintf(out, "%s%.1f,%.1f", k > 0 ? "," : "", place[0], place[1]);
    }
    fputc(']', out);
  }
  fputs("]]", out);
  free(at);
}

static const char head[] =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
    "content=\"width=device-width\">\n"
    "<title>carom shoot</title>\n"
    "<style>body{margin:1em "
    "auto;max-width:1200px;font-family:sans-serif}svg{width:100%;height:auto}p{display:flex;gap:"
    "1em;align-items:center}input{flex:1}</style>\n"
    "<p><button id=\"play\">Play</button><input id=\"time\" type=\"range\" min=\"0\" step=\"0.01\" "
    "aria-label=\"time\"><output id=\"said\"></output><select id=\"pace\" "
    "aria-label=\"speed\"><option value=\"0.25\">1/4<option value=\"0.5\">1/2<option value=\"1\" "
    "selected>1<option value=\"2\">2</select></p>\n";

static const char script[] =
    "const balls=document.querySelectorAll('g.ball'),get=id=>document.getElementById(id);\n"
    "const play=get('play'),time=get('time'),said=get('said'),pace=get('pace');\n"
    "const end=Math.max(...shots.map(s=>s[0][s[0].length-1]));\n"
    "let now=0,last=null;time.max=end;\n"
    "function place(t,times,xy){\n"
    "  let a=0,b=times.length-1;if(xy.length==2)return xy;\n"
    "  while(b-a>1){const m=(a+b)>>1;if(times[m]<=t)a=m;else b=m}\n"
    "  const s=b>a?Math.min(Math.max((t-times[a])/(times[b]-times[a]),0),1):0;\n"
    "  return[0,1].map(k=>xy[2*a+k]+s*(xy[2*b+k]-xy[2*a+k]))}\n"
    "function show(){\n"
    "  let k=0;for(const[times,paths]of shots)for(const xy of paths){\n"
    "    const g=balls[k++],[x,y]=place(now,times,xy);\n"
    "    if(now>=end)g.removeAttribute('transform');\n"
    "    else g.setAttribute('transform',`translate(${x-g.dataset.x} ${y-g.dataset.y})`)}\n"
    "  time.value=now;said.value=now.toFixed(2)+' s'}\n"
    "function frame(stamp){\n"
    "  "
    "if(last===null)return;now=Math.min(now+(stamp-last)/1000*pace.value,end);last=stamp;show();\n"
    "  if(now<end)requestAnimationFrame(frame);else stop()}\n"
    "function stop(){last=null;play.textContent='Play'}\n"
    "play.onclick=()=>{if(last!==null)return "
    "stop();if(now>=end)now=0;play.textContent='Pause';last=performance.now();"
    "requestAnimationFrame(frame)};\n"
    "time.oninput=()=>{stop();now=+time.value;show()};\n"
    "show();play.click();\n";

void shots_animate(FILE *out, const played *shots, int count, const char *footer) {
  fputs(head, out);
  shots_draw(out, shots, count, footer);
  fputs("<script>\nconst shots=[", out);
  for (int k = 0; k < count; k++) {
    fputs(k > 0 ? ",\n" : "", out);
    write_frames(out, &shots[k], k);
  }
  fprintf(out, "];\n%s</script>\n</html>\n", script);
}
