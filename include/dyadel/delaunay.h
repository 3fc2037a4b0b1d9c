/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The partial Delaunay triangulation of a table of sites: which pairs are certainly, possibly, never edges.
 *
 * For the rectangles as they are:
 *   possible(i,j)  some choice of points makes ij a (weakly) Delaunay edge: exact [POS-1];
 *   legal(i,j)     some disc holds R_i and R_j and meets no other rectangle: every choice makes ij a strictly
 *                  Delaunay edge, and the centre of the disc is the witness [LEG-1].
 * (mathematics: sections 3, 5, 6; KEL.) */
#ifndef DYADEL_DELAUNAY_H
#define DYADEL_DELAUNAY_H

#include <dyadel/sites.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The status of a pair.
 *
 * Exact sites on one line, with no site strictly beyond it, are possible pairs of one another, by discs that have grown
 * to half-planes; only neighbours can be legal. The others are ties where all sites of their face (dyd_delaunay_face)
 * are exact. Where the face also holds a rectangle, one that touches the line say, they are indeterminate, since ties
 * belong to whole faces; they become ties when the rectangle is narrowed until it leaves the face.
 *
 * A legal pair has a witness that was found. The search sees room for a witness down to 2^-128 of the square of the
 * least unit of the rectangles' ends by their size; where ends span more than about 2^200, it may end before it finds
 * narrow room, and the pair stays indeterminate: true, but less than could be said. */
typedef enum dyd_pair_status {
  DYD_ILLEGAL = 0,       /* an edge for no choice */
  DYD_TIE = 1,           /* indeterminate, and no refinement can decide it: all sites concerned are exact, or proved
                            to be on one circle or line */
  DYD_INDETERMINATE = 2, /* possible, no witness */
  DYD_LEGAL = 3          /* an edge for every choice */
} dyd_pair_status;
/* "illegal", "tie", "indeterminate", "legal". Static storage. */
DYD_API const char *dyd_pair_status_text(dyd_pair_status status);

/* Invariant: i < j. */
typedef struct dyd_pair {
  uint32_t i, j;
  dyd_pair_status status;
} dyd_pair;

/* Three sites, counter-clockwise for every choice, lowest number first. */
typedef struct dyd_triangle {
  uint32_t v[3];
} dyd_triangle;

/* Arrays owned by the caller: init with {0}, release with the _clear function. */
typedef struct dyd_pair_list {
  size_t count;
  dyd_pair *item;
} dyd_pair_list;
typedef struct dyd_triangle_list {
  size_t count;
  dyd_triangle *item;
} dyd_triangle_list;
typedef struct dyd_index_list {
  size_t count;
  uint32_t *item;
} dyd_index_list;
DYD_API void dyd_pair_list_clear(dyd_pair_list *l);
DYD_API void dyd_triangle_list_clear(dyd_triangle_list *l);
DYD_API void dyd_index_list_clear(dyd_index_list *l);

/* How many decisions each rung gave, since the object was made. */
typedef struct dyd_delaunay_counters {
  size_t struct_size;                     /* set by DYD_SIZED */
  uint64_t filter;                        /* decided in doubles */
  uint64_t integer;                       /* decided in fixed-size integers */
  uint64_t exact;                         /* decided in GMP integers */
  uint64_t witness_guess, witness_search; /* legal edges by the first guess / by search */
  uint64_t cover_walks;
  uint64_t faces;      /* undecided faces worked on */
  uint64_t bytes_most; /* the most that it was estimated to hold at once; 0: max_bytes was never set */
  uint64_t spare[7];   /* 0: for members to come, as other structs hold this one */
} dyd_delaunay_counters;

/* What true points may have in common. */
typedef enum dyd_relation {
  DYD_COINCIDENT = 0, /* two are the same place */
  DYD_COLLINEAR,      /* all are on one line */
  DYD_COCIRCULAR      /* all are on one circle */
} dyd_relation;

/* Callback that can prove relations which the rectangles do not show: sets *proved (false when called) if the true
 * points of the sites are proved to be in that relation, permanently. The sites of a polygon or chain come in order.
 * Returns DYD_OK, or a failure with *err (may be NULL) filled. */
typedef dyd_status (*dyd_prove_fn)(bool *proved, void *user, dyd_relation relation, const uint32_t *site, size_t count,
                                   dyd_error *err);

typedef struct dyd_delaunay_options {
  size_t struct_size;         /* set by DYD_SIZED */
  size_t max_pairs;           /* cap on stored pairs beyond the skeleton; 0: the default, 4e6 + 16 N. Ties where
                                 all sites are exact points are not stored */
  const volatile int *cancel; /* when it points to a non-zero value, work stops with DYD_CANCELLED; may be NULL */
  unsigned threads;           /* how many may be used, the calling one included; 0: one. Nothing else depends on it */
  bool no_filter;             /* decide everything on the exact rung (for tests; statuses are the same) */
  /* NULL, or the callback for polygons and chains that would have to be closed: where it proves that they are on one
   * circle or line, their pairs are ties [TIE-3]. Called from the calling thread only, during this call. */
  dyd_prove_fn prove;
  void *prove_user;
  /* dyd_delaunay_new: when work is stopped while undecided faces are closed, the others count as met by the cap, and
   * the result is DYD_CAPPED. */
  bool keep_cut;
  uint64_t max_bytes; /* memory for it, without the sites, by its own estimate: DYD_E_NOMEM before more is allocated,
                         with what took too much in *err; 0: no bound. Calls that make more of it later (lists of
                         pairs and triangles, voronoi.h, metric.h, graph.h, tolerance.h, survey.h) have the rest */
  /* NULL, or returns true if the rectangle of the site can still shrink as far as wanted. A face of many triangles
   * whose corners all can, or are points, is postponed: it is not closed but counts as met by the cap, since its many
   * pairs would be found for wide rectangles only. Called from all threads. */
  bool (*narrows)(void *user, uint32_t site);
  void *narrows_user;
} dyd_delaunay_options;

typedef struct dyd_delaunay dyd_delaunay;

/* Computes the partial triangulation of `sites`, which is borrowed until dyd_delaunay_free and must change only
 * as dyd_delaunay_update says. options may be NULL. Deterministic; the statuses do not depend on the thread count.
 * Returns DYD_OK; DYD_CAPPED with *out valid (pairs inside the faces that met the cap are all reported as
 * indeterminate by dyd_delaunay_status, err names sites concerned, dyd_delaunay_is_capped is true, and such pairs
 * are listed only as far as they are skeleton edges); DYD_CANCELLED or an error with *out = NULL.
 * Cost: O(N log N) for separated thin rectangles, plus work proportional to the undecided faces. */
DYD_API dyd_status dyd_delaunay_new(dyd_delaunay **out, const dyd_sites *sites, const dyd_delaunay_options *options,
                                    dyd_error *err);
DYD_API void dyd_delaunay_free(dyd_delaunay *pd);
/* Brings *pd up to date after dyd_sites_narrow of the `count` sites listed (any order, repeats allowed): only the
 * undecided faces that hold one of them are worked on again; legal pairs stay legal, illegal ones illegal.
 * On DYD_CANCELLED and errors *pd keeps its former statements, still valid, and the update can be repeated
 * (with the same or a larger list). */
DYD_API dyd_status dyd_delaunay_update(dyd_delaunay *pd, const uint32_t *changed, size_t count,
                                       const dyd_delaunay_options *options, dyd_error *err);

DYD_API const dyd_sites *dyd_delaunay_sites(const dyd_delaunay *pd);
DYD_API bool dyd_delaunay_is_capped(const dyd_delaunay *pd);
/* Number of pairs by status; index with dyd_pair_status (entry DYD_ILLEGAL is 0: they are not stored). */
DYD_API void dyd_delaunay_count(size_t count[4], const dyd_delaunay *pd);
DYD_API size_t dyd_delaunay_undecided_faces(const dyd_delaunay *pd);
DYD_API dyd_status dyd_delaunay_get_counters(dyd_delaunay_counters *out, const dyd_delaunay *pd, dyd_error *err);
DYD_API size_t dyd_delaunay_memory(const dyd_delaunay *pd);

/* The lowest site at the same place, with the same exact coordinates or joined with i: i itself unless i is an alias.
 * Aliases take part in nothing. */
DYD_API uint32_t dyd_delaunay_alias(const dyd_delaunay *pd, uint32_t i);
/* Status of a pair. Aliases answer for their site; i = j (or aliases of one another) is ILLEGAL. */
DYD_API dyd_pair_status dyd_delaunay_status(const dyd_delaunay *pd, uint32_t i, uint32_t j);
/* All possible pairs, sorted by i, then j. O(N + pairs). *out is replaced, owned by the caller. */
DYD_API dyd_status dyd_delaunay_pairs(dyd_pair_list *out, const dyd_delaunay *pd);
/* Receives a pair, i < j. */
typedef void (*dyd_pair_fn)(void *user, uint32_t i, uint32_t j, dyd_pair_status status);
/* The same pairs, each once, without the memory of a list, in an order that may change with the number of threads and
 * with releases. */
DYD_API void dyd_delaunay_each_pair(const dyd_delaunay *pd, dyd_pair_fn visit, void *user);
/* What sites that are tied have in common. */
typedef enum dyd_group_kind {
  DYD_GROUP_CIRCLE = 0, /* one empty circle: k sites, in its order, counter-clockwise, have k (k - 3) / 2 tied pairs */
  DYD_GROUP_CHAIN,      /* one line of the hull: k sites, along it, have (k - 1) (k - 2) / 2 tied pairs */
  DYD_GROUP_PAIR        /* a tied pair alone */
} dyd_group_kind;
/* Called with a group of ties; sites is borrowed for the call. A status other than DYD_OK ends the walk. */
typedef dyd_status (*dyd_group_fn)(void *user, dyd_group_kind kind, const dyd_index_list *sites);
/* Visits all ties as groups: each tied pair is in one group. Neighbours on the circle or line are legal, not tied.
 * Returns the status of `visit`, or DYD_E_NOMEM. O(sites of the groups). */
DYD_API dyd_status dyd_delaunay_each_group(const dyd_delaunay *pd, dyd_group_fn visit, void *user);
/* The sites whose pair with i has at least the status `least` (TIE or INDETERMINATE: all possible ones). Ascending.
 * O(log pairs + degree); where all points are on one line, O(N). */
DYD_API dyd_status dyd_delaunay_neighbours(dyd_index_list *out, const dyd_delaunay *pd, uint32_t i,
                                           dyd_pair_status least);
#define DYD_NO_TRIANGLE UINT32_MAX
/* Not sorted: several times as fast, in an order that may change with the number of threads and with releases.
 * Triangles near each other in the list are near each other in the plane. */
#define DYD_TRIANGLES_AS_FOUND 1u
/* Triangles with three legal edges that hold no site for any choice: Delaunay triangles for every choice. Sorted,
 * unless flags have DYD_TRIANGLES_AS_FOUND. neighbours, unless NULL, receives the adjacent triangles:
 * neighbours->item[t].v[k] is the number in the list of the triangle beyond the side opposite to corner k of triangle
 * t, DYD_NO_TRIANGLE where there is none that is certain (outside the hull, or in an undecided face). Both are
 * replaced, owned by the caller. DYD_E_ARG for other flags. O(N log N), as found O(N). */
DYD_API dyd_status dyd_delaunay_triangles(dyd_triangle_list *out, dyd_triangle_list *neighbours, const dyd_delaunay *pd,
                                          unsigned flags);
/* Finds the certain triangle that each place xy[2 k], xy[2 k + 1] is in. in[k] = DYD_TRUE: the place is in triangle
 * out[k], which has the form of dyd_delaunay_triangles, for every choice, or on a side of it whose ends are exact
 * points; of several the first by v[0], then v[1]. DYD_FALSE: it is outside of the convex hull for every choice.
 * DYD_UNKNOWN: neither is known, as in undecided faces; then, and outside, out[k].v[0] is DYD_NO_TRIANGLE. Rectangles
 * whose ends are not doubles count as rounded outward for DYD_FALSE; else exact. DYD_E_ARG for places that are not
 * finite; DYD_CANCELLED once *cancel, which may be NULL, is set. The caller provides both arrays; on failure their
 * contents are undefined. Cost: a walk from each place to the next, so order them to be near. */
DYD_API dyd_status dyd_delaunay_locate(dyd_triangle *out, dyd_truth *in, const dyd_delaunay *pd, const double *xy,
                                       size_t count, const volatile int *cancel);
/* Lists of sites for places: those of place k are site[end[k - 1]] to site[end[k] - 1] (read end[-1] as 0),
 * ascending. Owned: init with {0}. */
typedef struct dyd_place_list {
  size_t places;
  uint32_t *site;
  size_t *end;
  bool *sure;
} dyd_place_list;
DYD_API void dyd_place_list_clear(dyd_place_list *l);
/* Sets *out to the sites that may be corners of the Delaunay triangle that each place xy[2 k], xy[2 k + 1] is in, for
 * some choice; sure[k]: it is in one for every choice, not outside of the hull [LOC-6]. So a value interpolated between
 * the corners is within the values of these sites. Errors and `cancel` as for dyd_delaunay_locate; on failure *out is
 * unchanged. Cost: a walk from each place to the next, plus the triangles of the undecided faces that it may be in. */
DYD_API dyd_status dyd_delaunay_corners(dyd_place_list *out, const dyd_delaunay *pd, const double *xy, size_t count,
                                        const volatile int *cancel);
/* The sites of the undecided faces of the legal graph: face f (0 <= f < dyd_delaunay_undecided_faces). Ascending.
 * *outer is true if the face is unbounded (the unbounded face may come in parts, between certain corners of the hull).
 * Every non-legal possible pair lies in exactly one of them, up to its end points on the boundary. */
DYD_API dyd_status dyd_delaunay_face(dyd_index_list *out, bool *outer, const dyd_delaunay *pd, size_t f);
/* A witness of a legal pair: max(dl_i, dl_j)(c) < ds_k(c) for all other k, re-checked before it is given.
 * DYD_E_ARG when the pair is not legal. */
DYD_API dyd_status dyd_delaunay_witness(dyd_point *out, const dyd_delaunay *pd, uint32_t i, uint32_t j);

/* ---- convex hull ---- */

/* Status of the convex hull of the sites, since the ghost vertex is one of the vertices of the triangulation. As for
 * pairs, the possible part is closed and the certain part is open: an exact point in the middle of a side of the hull
 * is possible, not certain, and its pairs on that side are ties. Aliases are not listed. */
typedef struct dyd_hull {
  dyd_index_list sure_vertices;     /* corners of the hull for every choice; ascending */
  dyd_index_list possible_vertices; /* on its boundary for some choice, the certain ones included; ascending */
  /* The pairs ij for which some choice has all points on one closed side of a line through p_i and p_j; sorted. LEGAL:
   * for every choice all others are strictly on one side (so ij is an edge of the hull). TIE: not LEGAL, and i, j and
   * all that may be on the line with both are exact, or i and j are on one side of the hull with sites that are proved
   * to be on one line. */
  dyd_pair_list pairs;
} dyd_hull;
DYD_API void dyd_hull_clear(dyd_hull *h);
/* Exact [HST-1] [HST-2]. *out is replaced. If pairs is false, out->pairs is empty, whatever the number of pairs.
 * DYD_CAPPED: more pairs than the cap of pd; `pairs` is empty then, the rest is complete. O(h log h + pairs), h the
 * sites on the skeleton's hull or in unbounded undecided faces. */
DYD_API dyd_status dyd_delaunay_partial_hull(dyd_hull *out, const dyd_delaunay *pd, bool pairs);

#ifdef __cplusplus
}
#endif
#endif
