/* SPDX-License-Identifier: Apache-2.0 */
/* Reads the resources of the unit, and converts saved states to bytes and back. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "faces/fmu/drive.h"

static int hex_digit(char c) {
  return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* The path of a file URI ("file:///a%20b", "file:/a", "file://localhost/a"), or a plain path. Returns 0 if the path
   does not fit into `room`. */
static int path_of(const char* location, char* path, size_t room) {
  size_t out = 0;
  const int is_uri = strncmp(location, "file:", 5) == 0;
  if (is_uri) {
    location += 5;
    if (strncmp(location, "//", 2) == 0) {
      location = strchr(location + 2, '/');
      if (!location) return 0;
    }
  }
  for (; *location; ++location) {
    char c = *location;
    if (is_uri && c == '%' && hex_digit(location[1]) >= 0 && hex_digit(location[2]) >= 0) {
      c = (char)(16 * hex_digit(location[1]) + hex_digit(location[2]));
      location += 2;
    }
    if (out + 1 >= room) return 0;
    path[out++] = c;
  }
  while (out > 1 && path[out - 1] == '/') --out;
  path[out] = '\0';
  return out > 0;
}

static double double_of(unsigned long long bits) {
  const uint64_t exact = bits;
  double value;
  memcpy(&value, &exact, sizeof value);
  return value;
}

/* Whether `count` consecutive references from `first` on exist. */
static int is_reference(unsigned first, int count) {
  const unsigned end = first + (unsigned)count;
  if (count < 1 || count > DRIVE_ARRAY || first == 0) return 0;
  return (end <= DRIVE_SIGNALS && end <= (unsigned)sixstep_signal_count()) ||
         (first >= DRIVE_USES_TICKS && end <= DRIVE_USES_HALL + 1) ||
         (first >= DRIVE_FIRST_SET && end <= DRIVE_FIRST_SET + DRIVE_SETS) ||
         (first >= DRIVE_FIRST_MEASURED && end <= DRIVE_FIRST_MEASURED + DRIVE_MEASURED) ||
         (first >= DRIVE_FIRST_COUNT && end <= DRIVE_FIRST_COUNT + DRIVE_COUNTS);
}

static drive_kind kind_of(const char* word) {
  return strcmp(word, "real") == 0      ? DRIVE_REAL
         : strcmp(word, "integer") == 0 ? DRIVE_INTEGER
         : strcmp(word, "boolean") == 0 ? DRIVE_BOOLEAN
                                        : DRIVE_NONE;
}

static int read_input(unsigned reference, unsigned long long bits, const char* key, drive_variables* v) {
  if (v->inputs >= DRIVE_INPUTS || reference != DRIVE_FIRST_INPUT + (unsigned)v->inputs) return 0;
  strcpy(v->keys[v->inputs], key);
  v->kinds[reference] = DRIVE_REAL;
  v->starts[v->inputs++] = double_of(bits);
  return 1;
}

/* Reads a line of variables.txt: "token T", "chip 3", "real 15 BITS COUNT", "integer 24 BITS COUNT", "boolean 1100
 * BITS COUNT", "input 1000 BITS KEY". BITS are the bits of a double, so no locale changes the number. Returns 0 for
 * any other line. */
static int read_line(const char* line, drive_variables* v) {
  char word[16], last[64];
  unsigned reference, chip;
  unsigned long long bits;
  int k, count = 0;
  if (sscanf(line, "token %63s", v->token) == 1) return 1;
  if (sscanf(line, "chip %u", &chip) == 1) {
    v->chip = (sixstep_chip)chip;
    return chip <= SIXSTEP_CHIP_GATES;
  }
  if (sscanf(line, "%15s %u %llx %63s", word, &reference, &bits, last) != 4) return 0;
  if (strcmp(word, "input") == 0) return read_input(reference, bits, last, v);
  if (sscanf(last, "%d", &count) != 1 || !is_reference(reference, count)) return 0;
  v->kinds[reference] = kind_of(word);
  v->counts[reference] = count;
  for (k = 0; k < count; ++k) v->factors[reference + (unsigned)k] = double_of(bits);
  return v->kinds[reference] != DRIVE_NONE;
}

static int read_variables(const char* path, drive_variables* v) {
  char line[256];
  int good = 1;
  FILE* file = fopen(path, "r");
  if (!file) return 0;
  memset(v, 0, sizeof *v);
  v->kinds[0] = DRIVE_REAL; /* reference 0: the time */
  while (good && fgets(line, sizeof line, file)) good = read_line(line, v);
  fclose(file);
  return good && v->token[0];
}

drive_result drive_read(drive* self, const char* location, const char* token) {
  char folder[sizeof self->scenario], path[sizeof self->scenario + 16], text[DRIVE_MESSAGE];
  if (sixstep_abi() != SIXSTEP_ABI) return drive_fail(self, "libsixstep", "has another interface number than this unit requires");
  if (!location || !path_of(location, folder, sizeof folder - 16))
    return drive_fail(self, "resource location", "must be a URI such as file:///tmp/unit/resources");
  snprintf(path, sizeof path, "%s/variables.txt", folder);
  if (!read_variables(path, &self->variables)) {
    snprintf(text, sizeof text, "%.800s cannot be read, or is damaged; unzip the unit again", path);
    return drive_fail(self, "resource location", text);
  }
  if (!token || strcmp(token, self->variables.token) != 0)
    return drive_fail(self, "GUID or token", "differs from the unit's token; copy the token from the unit's modelDescription.xml");
  snprintf(self->scenario, sizeof self->scenario, "%.*s/scenario.toml", (int)sizeof self->scenario - 16, folder);
  drive_reset(self);
  return DRIVE_OK;
}

/* The saved state of the instance at the address `of`; null: there is none. */
static drive_state* find(const drive* self, const void* of) {
  drive_state* s = self->saved;
  while (s && s != of) s = s->next;
  return s;
}

static drive_result copy_state(const drive_state* from, drive_state* to) {
  sixstep_session* session = NULL;
  drive_state* next = to->next;
  if (from->session && sixstep_copy(from->session, &session) != SIXSTEP_OK) return DRIVE_ERROR;
  sixstep_free(to->session);
  *to = *from;
  to->session = session;
  to->next = next;
  return DRIVE_OK;
}

static drive_state* new_state(drive* self) {
  drive_state* s = calloc(1, sizeof *s);
  if (!s) return NULL;
  s->next = self->saved;
  self->saved = s;
  return s;
}

drive_result drive_save(drive* self, const char* function, void** at) {
  drive_state* to;
  if (!at) return drive_fail(self, function, "the pointer to the state is null");
  to = *at ? find(self, *at) : new_state(self);
  if (!to) return drive_fail(self, function, *at ? "the state does not belong to this instance" : "not enough memory");
  if (copy_state(&self->state, to) != DRIVE_OK) {
    void* fresh = to;
    if (!*at) drive_forget(self, function, &fresh);
    return drive_fail(self, function, "not enough memory");
  }
  *at = to;
  return DRIVE_OK;
}

drive_result drive_restore(drive* self, const char* function, const void* from) {
  const drive_state* s = find(self, from);
  if (!s) return drive_fail(self, function, "the state does not belong to this instance");
  return copy_state(s, &self->state) == DRIVE_OK ? DRIVE_OK : drive_fail(self, function, "not enough memory");
}

drive_result drive_forget(drive* self, const char* function, void** at) {
  drive_state **link = &self->saved, *s;
  if (!at || !*at) return DRIVE_OK;
  while (*link && *link != *at) link = &(*link)->next;
  if (!*link) return drive_fail(self, function, "the state does not belong to this instance");
  s = *link;
  *link = s->next;
  sixstep_free(s->session);
  free(s);
  *at = NULL;
  return DRIVE_OK;
}

/* Beginning of a saved state's bytes; the session's bytes follow. */
typedef struct {
  char magic[16];
  char token[64];
  drive_state state; /* its pointers are written as null */
  uint64_t session;  /* number of the session's bytes */
  uint64_t check;    /* checksum() of all bytes, itself 0 */
} head;

static const char magic[16] = "sixstep unit 2";

/* FNV-1a checksum: a change of any byte changes the sum. */
static uint64_t checksum(const head* h, const unsigned char* session) {
  uint64_t sum = 14695981039346656037u, n;
  unsigned char bytes[sizeof *h]; /* a copy by memcpy, because an assignment may omit padding */
  memcpy(bytes, h, sizeof bytes);
  memset(bytes + offsetof(head, check), 0, sizeof h->check);
  for (n = 0; n < sizeof bytes; ++n) sum = (sum ^ bytes[n]) * 1099511628211u;
  for (n = 0; n < h->session; ++n) sum = (sum ^ session[n]) * 1099511628211u;
  return sum;
}

size_t drive_bytes(drive* self, const void* of, unsigned char* bytes, size_t room) {
  const drive_state* s = find(self, of);
  head h;
  if (!s) return 0;
  memset(&h, 0, sizeof h);
  memcpy(h.magic, magic, sizeof h.magic);
  memcpy(h.token, self->variables.token, sizeof h.token);
  h.state = *s;
  h.state.session = NULL;
  h.state.next = NULL;
  if (s->session && !(h.session = sixstep_save(s->session, NULL, 0))) return 0;
  if (bytes && sizeof h + h.session <= room) {
    if (s->session) sixstep_save(s->session, bytes + sizeof h, room - sizeof h);
    h.check = checksum(&h, bytes + sizeof h);
    memcpy(bytes, &h, sizeof h);
  }
  return sizeof h + h.session;
}

static int is_phase(unsigned phase) {
  return phase == DRIVE_INSTANTIATED || phase == DRIVE_INITIALIZATION || phase == DRIVE_STEP_COMPLETE ||
         phase == DRIVE_STEP_FAILED || phase == DRIVE_TERMINATED || phase == DRIVE_EVENT;
}

static int is_head(const drive* self, const head* h, size_t count) {
  return memcmp(h->magic, magic, sizeof magic) == 0 && memcmp(h->token, self->variables.token, sizeof h->token) == 0 &&
         h->session == count - sizeof *h && is_phase((unsigned)h->state.phase) && memchr(h->state.digest, 0, 17) &&
         (h->state.phase == DRIVE_INSTANTIATED || h->session > 0);
}

drive_result drive_from_bytes(drive* self, const char* function, const unsigned char* bytes, size_t count, void** at) {
  head h;
  sixstep_session* session = NULL;
  sixstep_status status;
  drive_state* to;
  if (!bytes || !at || count < sizeof h) return drive_fail(self, function, "the bytes are not a saved state of this unit");
  memcpy(&h, bytes, sizeof h);
  if (!is_head(self, &h, count)) return drive_fail(self, function, "the bytes are not a saved state of this unit");
  if (checksum(&h, bytes + sizeof h) != h.check)
    return drive_fail(self, function, "the bytes of the saved state are damaged: the checksum differs");
  if (h.session) {
    status = sixstep_load(bytes + sizeof h, (size_t)h.session, &session);
    if (status != SIXSTEP_OK && status != SIXSTEP_OVER) {
      sixstep_free(session);
      return drive_fail(self, function, "the saved session cannot be loaded: it is damaged, or of another version");
    }
  }
  to = *at ? find(self, *at) : new_state(self);
  if (!to) {
    sixstep_free(session);
    return drive_fail(self, function, *at ? "the state does not belong to this instance" : "not enough memory");
  }
  h.state.next = to->next;
  sixstep_free(to->session);
  *to = h.state;
  to->session = session;
  *at = to;
  return DRIVE_OK;
}
