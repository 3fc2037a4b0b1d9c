/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Certificates: a result together with what proves it, and the independent check of it.
 *
 * A certificate is a text that anybody can check with integer arithmetic. The checker (src/checker) shares no code with
 * the engine but the numbers.
 * The format and what it proves, [CERT-1] to [CERT-14]: proofs/certificates.md.
 */
#ifndef DYADEL_CERTIFICATE_H
#define DYADEL_CERTIFICATE_H

#include <dyadel/status.h>
#include <stdbool.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

struct dyd_engine;
struct dyd_rect;
struct dyd_pair_list;
struct dyd_graph_list;
struct dyd_nearest_answer;

/* What a certificate says, beside the pairs of the rectangles. Borrowed for the call; what is NULL or false is left
 * out. */
typedef struct dyd_certificate_parts {
  size_t struct_size;                 /* set by DYD_SIZED */
  const struct dyd_pair_list *discs;  /* the pairs of dyd_disc_pairs [CERT-11] */
  const struct dyd_graph_list *graph; /* the edges of dyd_graph_edges [CERT-13] */
  int kind;                           /* of the graph, a dyd_graph */
  /* A section on the Voronoi diagram in the window, which has dyadic ends and positive area. NULL: as
   * dyd_voronoi_window. A result that is capped has no such section. The bound of the area is that of
   * dyd_metric_voronoi with polygons within a 256th of a cell, or as fine as a goal on it asks; H is that of
   * dyd_metric_voronoi, too, or at most four times as much (but within the goal that was reached), or it is unproved.
   * DYD_E_ARG for a wrong window; DYD_E_RANGE when there is no window by default, or polygons leave the range of
   * numbers. */
  bool diagram;
  const struct dyd_rect *window;
  const struct dyd_sphere *sphere; /* the current result of a sphere, with a section on it; e is ignored */
  /* The answers of dyd_engine_nearest, dyd_disc_nearest or, with a sphere, dyd_sphere_nearest to so many places, for
   * the rectangles as they are now, and their outcome, a dyd_outcome, in place of everything else [CERT-12]. An answer
   * that is certain only by less than rounding takes becomes one that is not, and the outcome budget; bounds of
   * distances may be wider than those of the answers. */
  const struct dyd_nearest_answer *const *answer;
  size_t answers;
  int outcome;
} dyd_certificate_parts;

/* Writes the certificate of the current result of e, for every outcome that has one. parts may be NULL. DYD_E_ARG when
 * there is no result, or a goal on the diagram was certified and it is not a part; DYD_E_NOMEM; DYD_E_IO. Then what was
 * written is no certificate: the last line, "end", is missing. Cost: about N log N, plus a search for chains in
 * undecided faces, which gives up after about half a minute (such pairs are counted as unproved). */
DYD_API dyd_status dyd_write_certificate(FILE *out, const struct dyd_engine *e, const dyd_certificate_parts *parts,
                                         dyd_error *err);

/* What an accepted certificate states without a proof; bits of dyd_certificate_report.gaps. */
typedef enum dyd_certificate_gap {
  DYD_GAP_LEGAL = 1,      /* that pairs without a witness are legal */
  DYD_GAP_ILLEGAL = 2,    /* that pairs which are not listed are illegal */
  DYD_GAP_TIES = 4,       /* that a pair is a tie: no face with both its sites is seen to be on one circle or line */
  DYD_GAP_BOUNDS = 8,     /* area, hausdorff: pairs that are not listed may be possible */
  DYD_GAP_DISTANCE = 16,  /* the distance in the diagram */
  DYD_GAP_OUTCOME = 32,   /* the outcome */
  DYD_GAP_POINTS = 64,    /* that the points given lie in its rectangles, and are what it describes */
  DYD_GAP_ALIASES = 128,  /* that aliases of sites that are not exact are the same points */
  DYD_GAP_CLAIMS = 256,   /* that callbacks are what their authors say they are */
  DYD_GAP_DISCS = 512,    /* that discs make pairs legal or illegal */
  DYD_GAP_GRAPH = 1024,   /* that pairs without a row are no edges of the graph; mst: or certain rows certain */
  DYD_GAP_NEAREST = 2048, /* that sites which are not listed are not nearest to a place */
  DYD_GAP_IMAGES = 4096,  /* on a sphere: that rectangles hold the images of their places */
  DYD_GAP_AROUND = 8192,  /* on a sphere: that places which are not listed are no neighbours of the eye */
  DYD_GAP_SPHERE = DYD_GAP_IMAGES | DYD_GAP_AROUND
} dyd_certificate_gap;

/* What an accepted certificate states. Texts have static storage. */
typedef struct dyd_certificate_report {
  size_t struct_size; /* set by DYD_SIZED */
  const char *outcome, *goal;
  long long goal_bits; /* of all goals but "decided": the bound is to be at most 2^-goal_bits */
  bool capped;
  size_t sites, aliases;
  size_t legal;          /* proved by witnesses */
  size_t legal_unproved; /* without a witness */
  size_t indeterminate, tie;
  size_t illegal_chains; /* pairs within undecided faces that are proved illegal one by one */
  uint64_t unproved;     /* pairs within undecided faces stated illegal (or not stated, when capped), not proved */
  size_t triangles;      /* sure triangles */
  size_t corners;        /* sure corners of the hull */
  size_t undecided_sets; /* faces and parts of the unbounded face that are not proved to be decided */
  bool connected;        /* were the faces found? */
  bool area, hausdorff;  /* is there a bound? Then it was checked against the pairs listed */
  bool diagram;          /* is there a section on the Voronoi diagram? Then its area was checked */
  size_t polygons;
  bool distance, distance_proved; /* is its other bound stated; was it checked? */
  size_t ties_unproved;           /* of the ties, those not proved to be ties */
  uint64_t illegal_boxes;         /* pairs within undecided faces that boxes prove illegal */
  unsigned gaps;                  /* of dyd_certificate_gap; 0: everything that is stated is proved */
  bool bound;                     /* were the points given, and is it about them? */
  size_t unlocated;               /* of them, those not known to lie in their rectangles */
  size_t aliases_unproved;        /* of aliases, those of sites that are not exact, and are not proved to be the same */
  size_t undescribed;             /* of the points given, those not known to be what the certificate describes */
  size_t claims;                  /* that callbacks are the roots that their authors say */
  size_t identities, tie_bounds;  /* facts about what points are: proved by an identity, by a bound [CERT-10] */
  size_t discs;                   /* the points lie in so many discs; 0: in rectangles */
  bool discs_fixed;               /* and nothing is ever narrowed */
  size_t discs_legal, discs_illegal, discs_unproved; /* pairs that the discs decide, by what proves it */
  const char *graph;                                 /* the graph that is stated; NULL: none */
  size_t graph_rows, graph_certain;
  uint64_t graph_unproved;       /* pairs without a row that are not proved to be no edges */
  size_t places, places_certain; /* places of queries; those with a site that is certainly nearest */
  uint64_t near_unproved;        /* sites not proved to be nearest nowhere in a place that does not list them */
  bool sphere, gap, second;      /* is it about places on a sphere [CERT-14]; from a gap; from a second eye as well? */
  size_t sphere_places;          /* what follows is 0 elsewhere; unproved ones are counted for both eyes */
  size_t legal_around;           /* pairs with the eye that are proved to be legal */
  size_t second_legal;           /* pairs that are proved to be legal from there */
  size_t images_unproved;        /* rectangles that are not proved to hold the image of their place */
  size_t around_unproved;        /* images that are not proved to be no neighbours of the eye */
} dyd_certificate_report;

struct dyd_engine_options;
struct dyd_sphere_options;
/* The points that a certificate is to be about. Borrowed for the call. */
typedef struct dyd_verify_options {
  size_t struct_size; /* set by DYD_SIZED */
  /* Site k is about point k of the engine: as many; the rectangle of a fixed point is that of its site; any other point
   * is asked until its rectangle lies in that of its site, so far as options allow (NULL: as for dyd_engine_ask; a
   * point that is not seen to lie there is a gap, one that lies outside rejects). Points that turn out final there are
   * known never to be narrowed, which may prove "fixpoint". A point that blocks describe has to be made in that way,
   * number by number; else that, too, is a gap. NULL: the points are not known. */
  struct dyd_engine *engine;
  const struct dyd_engine_options *options;
  /* The points lie in the discs in their rectangles, which have to be squares; without it a certificate of discs is one
   * of these points only where their rectangles lie in the discs. */
  bool discs;
  /* The points are places on a sphere, as for dyd_sphere_new, the radius here is that of the certificate, and so are
   * those of rows; NULL: points of a plane. DYD_E_DOMAIN: one of the two is about a plane, the other about a sphere. */
  const struct dyd_sphere_options *sphere;
  /* Of an accepted certificate, the sites that stay where they are go here (NULL: nowhere), a line each, in order:
   * point k is fixed or final, and its rectangle is that of site k. `dyadel-proved --still` reads it. DYD_E_IO, too,
   * when it cannot be written. */
  FILE *still;
} dyd_verify_options;

/* Checks the certificate in `in` up to its end, in integers, and that it is about the points given (about may be NULL).
 * DYD_OK: accepted, *out is what it states. DYD_E_PARSE: rejected; err has the line and the reason. DYD_E_IO,
 * DYD_E_NOMEM: not known; with points, also the errors of dyd_engine_ask and DYD_CANCELLED. err may be NULL. Memory:
 * linear in the number of sites and legal pairs. Cost: near-linear where each disc meets few rectangles. */
DYD_API dyd_status dyd_verify_certificate(dyd_certificate_report *out, FILE *in, const dyd_verify_options *about,
                                          dyd_error *err);

#ifdef __cplusplus
}
#endif
#endif
