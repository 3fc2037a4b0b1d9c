/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Certificates: a result together with what proves it, and the independent check of it.
 *
 * A certificate is a text that anybody can check with integer arithmetic; the format is fixed below, and what it
 * proves is said there too. dyd_verify_certificate shares no code with the engine but the numbers (src/checker).
 *
 * Format. Lines of UTF-8 ended by '\n', words divided by single blanks, no other blank. A number is
 *     m       an integer      or      m*2^e    m odd, e not 0
 * in decimal, without leading zeros or plus signs; a coordinate of a site is
 *     lo      an exact dyadic
 *     lo/d    an exact rational, d > 1 odd
 *     lo+w    the interval [lo, lo + w], w > 0.
 * Sites are numbered from 0. In pairs i < j; lists are sorted by i, then by j, without repeats.
 *
 *     dyadel certificate 1
 *     outcome decided | certified | fixpoint | budget | cancelled | error
 *     goal decided | area M | hausdorff M | voronoi area M | voronoi hausdorff M | nearest
 *     capped no | yes
 *     sites N
 *       X Y                 N lines: the rectangle of a site; or
 *       = K                   the same point as site K, a lower number and itself no such line (an alias)
 *     legal L
 *       i j x y             L lines: the pair is legal, (x,y) is the witness
 *     places P
 *       i x y               P lines: the place of a site, a point of its
 *                           rectangle; of other sites: the lower left corner
 *     bridges B
 *       i j x y             B lines: see [CERT-2]
 *     corners C
 *       i x y               C lines: site i is a corner of the hull for every
 *                           choice, outward direction (x,y)
 *     pairs
 *       o i j               indeterminate
 *       t i j               tie
 *       l i j               legal without a witness
 *       n i j x y k x y k ... x y k x y
 *                           illegal, proved by a chain: a direction, then
 *                           blocker and point by turns, a blocker, a direction
 *     boxes P             (or no such line) of the other pairs boxes prove P illegal
 *     triangles T
 *     unproved U
 *     area A | none         upper bounds, see metric.h
 *     hausdorff H | none
 *
 * then blocks, where ties or aliases follow from what points are,
 *
 *     algebra K             K numbers, each made of those before (a, b) in one of these ways:
 *       = V                   a value, see below
 *       + a b, - a b, * a b, / a b, min a b, max a b, ^ a n, neg a, abs a
 *       sqrt a, cbrt a, cos a, sin a, tan a, exp a, sinh a, cosh a, tanh a, log a, asin a, acos a, atan a, pi, e
 *       cycle N               2 cos(2 pi/N), one at most
 *       root LO HI c0,...,cn  the zero of c0 + ... + cn X^n, cn > 0, between the fractions LO and HI
 *       callback              of which nothing is known
 *       claim a               what a callback gives; its author says that it is a
 *                             sqrt, cbrt and root may be followed by V: the number is V
 *     points G
 *       i a b               G lines: site i is the point (a,b), numbers of the block; sorted by i
 *     facts F
 *       same i j M            sites i and j are the same point
 *       line i j k ... M      all these are on the line of i and j
 *       circle i j k l ... M  all these are on the circle of i, j and k; M: identity | bound
 *
 * then, where each point is known to lie in a disc, too,
 *
 *     discs C               or: discs C fixed
 *       x y r               C lines: for each site that is no alias, in order, the disc of radius r about (x,y)
 *     refined M             M pairs that the rectangles leave indeterminate, in order
 *       l i j [x y]           legal for the discs; (x,y) is the witness
 *       n i j [k k ...]       illegal for the discs, by what the discs of sites k forbid
 *
 * then, where a graph of neighbours (graph.h) is stated,
 *
 *     graph nearest G       or: graph gabriel G
 *       c i j               G rows, in order: the edge is certain; or
 *       p i j                 the edge is possible
 *
 * then, where the certificate says something of the Voronoi diagram,
 *
 *     window XLO XHI YLO YHI
 *     polygons
 *       i x y x y x y ...   a polygon whose points are surely nearest to site
 *                           i; sorted by i, one at most for each site
 *     undetermined A        upper bounds on the window, see metric.h
 *     distance none | H | H unproved
 *
 * or, where the sites are images of places on a sphere, see sphere.h; LON, LAT and R are coordinates of sites,
 *
 *     sphere
 *     eye K | gap LON LAT   projected from place K, or from a point where no place is
 *     radius none | degrees R | metres R
 *     places N
 *       LON LAT               N lines: longitude and latitude in degrees
 *       LON LAT M             and the point is up to M metres away
 *       LON LAT = K           exactly the same place as place K, which has no such line
 *     neighbours C
 *       l k                   C lines, sorted by k: the image that is site k is a corner of the hull for every choice
 *       l k x y               the same, proved by an outward direction
 *       t k                   it is a tie with the eye
 *       o k                   it may be a neighbour of the eye, or of a point at the gap
 *     also                    (or no such line) then a whole certificate, from "dyadel certificate 1" to its own
 *                             "end", of the same places from another eye; without the lines radius and places
 *     outcome                 as above; the one at the beginning is that of the images
 *
 * and at last
 *
 *     end
 *
 * With the goal nearest, the places of queries follow the sites in place of all this, and "end" follows them:
 *
 *     nearest Q
 *       X Y c i LO HI             Q lines: the rectangle of a place, written as that of a site, and the site that is
 *                                 certainly nearest to it, at a distance in [LO,HI]; HI may be "none"; or
 *       X Y p i LO HI i LO HI ... all sites that may be nearest to it, in order
 *
 * A number that is not rational in those before is a leaf: x0, x1, ... in their order. An irrational sqrt, cbrt or
 * root without V makes one (times its denominator: of sqrt a, a = p/q, the leaf is sqrt(p q); of a root cn X), cycle
 * one, cos, sin and tan two, the cosine and the sine, unless they are of a rational multiple
 * of pi, or another has the same angle or its negative; exp, e, pi and the others one unless there is one of the
 * same. V is P or P/Q, polynomials with integer coefficients in leaves before, their terms in descending order of
 * exponents, later leaves first: 2*x0*x2^3-x1+5.
 *
 * Aliases occur in no pair. Pairs of sites without a line are stated to be illegal, unless capped.
 *
 * What is proved, c being a point, ds_k and dl_k the least and the greatest distance from it to rectangle k:
 *
 * [CERT-1] Legal pairs: max(dl_i, dl_j)(c) < ds_k(c) at the witness c, for all other sites k but aliases: whatever the
 * points are, the segment from point i to point j is a strictly Delaunay edge.
 *
 * [CERT-2] The faces of the graph of legal pairs, drawn with the places as points; a bridge is an edge between two
 * places with a centre (x,y) nearer to both than to all other places, that joins two sites not connected by legal pairs
 * and other bridges. Legal pairs and bridges must connect all sites, joined ones having different places (else the
 * faces are not known, and C = T = 0); then each face is one closed walk. T is the number of bounded faces with three
 * legal edges: triangles for every choice, without a further site. A pair that is possible has both sites on one of the
 * other faces, or is a side of a triangle.
 *
 * [CERT-3] Corners cut the walk of the unbounded face into parts; two parts with a bridge in common are of one group. A
 * corner occurs once in the walk, is a strict corner of the hull of the places, and surely beyond, in its direction,
 * all other sites of the groups on its two sides. A possible pair of the unbounded face is within one group. A group of
 * two sites that are a legal pair is done. What is left of [CERT-2] and [CERT-3] are the open sets of sites.
 *
 * [CERT-4] Chains: on each piece of the chain (the ray from the first point in the first direction, the segments, the
 * ray from the last point in the last direction) its blocker k has dl_k < ds_i and dl_k < ds_j at the ends, on rays
 * also u.x < u.y for all x of rectangle i or j and y of rectangle k, u the direction; and the chain crosses the segment
 * between the places of i and j an odd number of times. Then no centre, finite or not, is possibly nearest to both.
 *
 * [CERT-9] Boxes: there is no list to prove them, the checker finds it (src/checker/boxes.c): it cuts the plane into
 * boxes until none holds the centres of two sites whose pair is not listed.
 *
 * [CERT-5] The bounds: the sum of the areas of the hulls of R_i and R_j over all pairs listed, chains apart; the
 * greatest diameter of a rectangle of such a pair, for pairs that are not legal plus half their greatest length.
 *
 * [CERT-6] Polygons: the vertices (at least three) are those of a strictly convex polygon, counter-clockwise; each lies
 * in the window and has dl_i < ds_k for all other sites k but aliases. Then the polygon lies in Int_i (voronoi.h), and
 * the area of the window outside of all Int_k is at most A, the area of the window less those of the polygons.
 *
 * [CERT-7] The distance: for every choice of points, what of the window is outside of all Int_k is at most H from the
 * true diagram. There is no list to prove it; it follows from the rectangles, and the checker finds the proof: it cuts
 * the window in four, and parts again, until the sites that are possibly nearest somewhere in a part give the bound
 * there (src/checker/distance.c). Whether a bound can be proved within the effort that the checker spends, which is
 * about N log N, is up to the writer, who may write "unproved": then nothing is checked. Nothing else in the
 * certificate is needed.
 *
 * [CERT-10] Blocks: each point lies in the rectangle of its site; the determinants that a fact is about reduce to 0
 * modulo the relations of the leaves (identity), or are smaller than any that is not 0 (bound). A circle through all
 * sites of a bounded face of legal edges, or a line through all sites of a part of the unbounded face, makes its
 * pairs ties; of exact points, which no block describes, the checker finds it.
 *
 * [CERT-11] Discs: each point lies in its rectangle and in its disc. Legal by a witness: |c - p_i| + r_i and |c - p_j|
 * + r_j are less than |c - p_k| - r_k for all other sites k but aliases, p_k being the centre of the disc of k.
 * Illegal: the discs of i and j are disjoint, and the caps of directions that the sites in the line forbid hold all
 * directions. "fixed" says that nothing is ever narrowed, of no site: with points given, that is compared, too.
 *
 * [CERT-12] Places: certain: dl_i < ds_k for all other sites at the corners of the place. Sites that are not listed are
 * nearest nowhere in the place, since a site that is listed is nearer; the checker cuts the place until one site is
 * nearer in all of a part. Distances lie in their bounds.
 *
 * [CERT-13] Graphs. nearest: as for places, each site being the place and taking no part. gabriel: certain when
 * (p_k - p_i).(p_k - p_j) > 0 for every choice and all k; a possible pair that has no row is no edge, since around each
 * middle of the two rectangles some k, in a possible pair with i, is inside the smallest disc of the pair.
 * [CERT-14] The sphere: the sites are the images of all places but the eye and aliases, in their order: stereographic,
 * onto the plane through the middle of the sphere, with axes to the east and to the north at the eye. A place may be
 * anywhere up to M metres from where longitude and latitude, each off by up to R degrees, may be; metres are those of
 * DYD_EARTH_RADIUS, and R metres are added to M. A pole alone has longitude 0; where latitudes reach beyond one, the
 * longitude is any. Each rectangle holds the images of all of that, seen from everywhere in the least box of degrees,
 * about, that holds where the eye may be. Legal and illegal pairs of the plane are so for places; a place is a
 * neighbour of the eye as the list says, and one that is not listed is none. From a gap, pairs of two listed images
 * that are no pairs of the plane are indeterminate. Of two certificates each proves what it states; open is what is
 * open in both.
 *
 * U counts, over the open sets, the pairs within the set that have no line and are none of the P: nothing proves that
 * they are illegal (0: the certificate proves its list of pairs complete). decided needs no o, t and l line and capped
 * no; certified needs the goal's bound.
 *
 * [CERT-8] What is stated need not be proved; the report says what is not (dyd_certificate_gap). A line o states
 * nothing of its pair, a line t that it is a tie: an edge of some Delaunay triangulation and of some not, whatever is
 * narrowed. That is proved where all sites of a bounded face of legal edges are on one circle, or all sites of a part
 * of the unbounded face on one line: as exact points, or as a fact says. fixpoint is proved where no site that matters
 * can be narrowed. That an alias of a site that is not exact is the same point is proved by facts. decided and bounds
 * are proved when U = 0. Nothing proves budget, cancelled and error, and lines l. A row p, and a place without a site
 * that is certain, state nothing but that the others are none. */
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

/* Writes the certificate of the current result of e, for every outcome that has one. No section on the diagram.
 * DYD_E_ARG when e has no result, or a goal on the diagram was certified (see below); DYD_E_NOMEM; DYD_E_IO. Then what
 * was written is no certificate: the last line, "end", is missing. Cost: about N log N, plus a search for chains in
 * undecided faces, which gives up after about half a minute (such pairs are counted as unproved). */
DYD_API dyd_status dyd_write_certificate(FILE *out, const struct dyd_engine *e, dyd_error *err);

struct dyd_sphere;
/* The certificate of the current result of s, with a section on the sphere. Errors and cost as above. */
DYD_API dyd_status dyd_write_sphere_certificate(FILE *out, const struct dyd_sphere *s, dyd_error *err);

/* The same as the first with a section on the Voronoi diagram in the window, which has dyadic ends and positive area.
 * NULL: as dyd_voronoi_window. A result that is capped has no such section. The bound of the area is that of
 * dyd_metric_voronoi with polygons within a 256th of a cell, or as fine as a goal on it asks; H is that of
 * dyd_metric_voronoi, too, or at most four times as much (but within the goal that was reached), or it is unproved.
 * DYD_E_ARG for a wrong window; DYD_E_RANGE when there is no window by default, or polygons leave the range of numbers.
 */
DYD_API dyd_status dyd_write_voronoi_certificate(FILE *out, const struct dyd_engine *e, const struct dyd_rect *window,
                                                 dyd_error *err);

/* What a certificate says beside the pairs of the rectangles. Borrowed for the call; what is NULL is left out. */
typedef struct dyd_certificate_parts {
  size_t struct_size;                 /* set by DYD_SIZED */
  const struct dyd_pair_list *discs;  /* the pairs of dyd_disc_pairs [CERT-11] */
  const struct dyd_graph_list *graph; /* the edges of dyd_graph_edges [CERT-13] */
  int kind;                           /* of the graph, a dyd_graph. DYD_GRAPH_MST is refused by DYD_E_ARG */
} dyd_certificate_parts;
/* As dyd_write_certificate, with these parts. */
DYD_API dyd_status dyd_write_certificate_parts(FILE *out, const struct dyd_engine *e,
                                               const dyd_certificate_parts *parts, dyd_error *err);
/* Writes a certificate of the answers of dyd_engine_nearest to `count` places, for the rectangles of e as they are now,
 * and their outcome, a dyd_outcome. Errors as above. [CERT-12] */
DYD_API dyd_status dyd_write_nearest_certificate(FILE *out, const struct dyd_engine *e,
                                                 const struct dyd_nearest_answer *const *answer, size_t count,
                                                 int outcome, dyd_error *err);

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
  DYD_GAP_GRAPH = 1024,   /* that pairs without a row are no edges of the graph */
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

/* Checks the certificate in `in` up to its end, in integers. DYD_OK: accepted, *out is what it states. DYD_E_PARSE:
 * rejected; err has the line and the reason. DYD_E_IO, DYD_E_NOMEM: not known. err may be NULL. Memory: linear in the
 * number of sites and legal pairs. Cost: near-linear where each disc meets few rectangles. */
DYD_API dyd_status dyd_verify_certificate(dyd_certificate_report *out, FILE *in, dyd_error *err);

struct dyd_engine_options;
/* The same, and that the certificate is about the points of e, site k about point k: as many; the rectangle of a fixed
 * point is that of its site; any other point is asked until its rectangle lies in that of its site, so far as options
 * allow (NULL: as for dyd_engine_ask; a point that is not seen to lie there is a gap, one that lies outside rejects).
 * Points that turn out final there are known never to be narrowed, which may prove "fixpoint". A point that blocks
 * describe has to be made in that way, number by number; else that, too, is a gap. Besides the errors above
 * those of dyd_engine_ask; DYD_CANCELLED. */
DYD_API dyd_status dyd_verify_certificate_of(dyd_certificate_report *out, FILE *in, struct dyd_engine *e,
                                             const struct dyd_engine_options *options, dyd_error *err);
/* The same; of an accepted certificate, the sites that stay where they are go to `still` (or NULL), a line each, in
 * order: point k is fixed or final, and its rectangle is that of site k. `dyadel-proved --still` reads it. DYD_E_IO,
 * too, when it cannot be written. */
DYD_API dyd_status dyd_verify_certificate_still(dyd_certificate_report *out, FILE *still, FILE *in,
                                                struct dyd_engine *e, const struct dyd_engine_options *options,
                                                dyd_error *err);
struct dyd_sphere_options;
/* The same; discs: the points of e lie in the discs in their rectangles, which have to be squares; without it a
 * certificate of discs is one of these points only where their rectangles lie in the discs. sphere not NULL: the points
 * of e are places on a sphere, as for dyd_sphere_new, the radius in the options is that of the certificate, and so are
 * those of rows. DYD_E_DOMAIN: one of the two is about a plane, the other about a sphere. */
DYD_API dyd_status dyd_verify_certificate_on(dyd_certificate_report *out, FILE *still, FILE *in, struct dyd_engine *e,
                                             bool discs, const struct dyd_sphere_options *sphere,
                                             const struct dyd_engine_options *options, dyd_error *err);

#ifdef __cplusplus
}
#endif
#endif
