/* Ways in words, and as the lines of their strokes. */
#include "way_words.h"

#include <math.h>
#include <string.h>

/* "left, 2": the rails and balls of a way. */
const char *parts_text(const ways_search *s, const way *w, char text[PARTS_TEXT]) {
  text[0] = '\0';
  for (int k = 0; k < w->parts; k++) {
    const bool rail = w->part[k].kind == CAROM_PART_RAIL;
    const char *name = rail ? carom_rail_name(&s->line->table->table, w->part[k].index) : NULL;
    snprintf(text + strlen(text), PARTS_TEXT - strlen(text), "%s%s", k > 0 ? ", " : "",
             name != NULL ? name
             : rail       ? s->line->table->rail[w->part[k].index]
                          : s->line->name[w->part[k].index]);
  }
  return text;
}

/* "1 to foot-left, bank: left" */
const char *way_text(const ways_search *s, const way *w, char text[WAY_TEXT]) {
  char parts[PARTS_TEXT];
  const char *pocket = w->pocket >= 0 ? carom_pocket_name(&s->line->table->table, w->pocket) : NULL;
  parts_text(s, w, parts);
  if (w->ball < 0)
    snprintf(text, WAY_TEXT, "%s", w->parts > 0 ? parts : "straight");
  else
    snprintf(text, WAY_TEXT, "%s to %s, %s%s%s", s->line->name[w->ball],
             pocket != NULL ? pocket : s->line->table->pocket[w->pocket], way_names[w->kind],
             w->parts > 0 ? ": " : "", parts);
  return text;
}

/* "30.6 left"; nothing where the cut is not known. */
const char *cut_text(const way *w, char text[CUT_TEXT]) {
  text[0] = '\0';
  if (!isnan(w->cut))
    snprintf(text, CUT_TEXT, "%.1f %s", fabs(w->cut), w->cut < 0.0 ? "right" : "left");
  return text;
}

/* The line of a way's stroke. */
json_t *way_line(const ways_search *s, const way *w) {
  char text[WAY_TEXT], parts[PARTS_TEXT];
  json_t *to = json_object(), *cue = json_object();
  json_object_set_new(to, "kind", json_string("shot"));
  json_object_set_new(to, "id", json_string(way_text(s, w, text)));
  json_object_set_new(to, "table", json_string(s->line->table->id));
  const json_t *given = json_object_get(s->line->json, "cue");
  if (given != NULL)
    json_object_update(cue, (json_t *)given);
  const carom_number *n;
  for (int k = 0; (n = carom_number_of(CAROM_PART_CUE, k)) != NULL; k++) {
    double x = 0.0;
    if (n->key[0] != '\0')
      memcpy(&x, (const char *)&w->cue + n->offset, sizeof x);
    if (n->offset <= (int32_t)offsetof(carom_cue, b))
      json_object_set_new(cue, n->key, json_real(x + 0.0));
  }
  json_object_set_new(to, "cue", cue);
  json_object_set_new(to, "balls", json_deep_copy(json_object_get(s->line->json, "balls")));
  json_t *about = json_pack("{s: s, s: s, s: f, s: f, s: [f, f]}", "kind", way_names[w->kind], "by",
                            parts_text(s, w, parts), "chance", w->chance, "error", w->error,
                            "window", w->phi[0], w->phi[1]);
  if (w->ball < 0)
    json_object_set_new(about, "share", json_real((double)w->found / (double)s->scanned));
  else
    json_object_set_new(about, "ball", json_string(s->line->name[w->ball]));
  if (!isnan(w->cut))
    json_object_set_new(about, "cut", json_real(w->cut));
  json_object_set_new(to, "way", about);
  return to;
}
