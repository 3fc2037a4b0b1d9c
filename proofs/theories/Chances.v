(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Sides of a circle, for each point separately, that make a pair an edge: half-planes, and rectangles across the
   direction to the centre [TOL-7]. *)
From Coq Require Import Reals Lra Psatz.
From Dyadel Require Import Plane Distance Cells Legal.
Open Scope R_scope.

(* How far z is from c in the direction u, a unit vector, and across it. *)
Definition ahead_of (c u z : point) : R := dot u (fst z - fst c, snd z - snd c).
Definition beside (c u z : point) : R := dot (- snd u, fst u) (fst z - fst c, snd z - snd c).

Lemma frame c u z : dot u u = 1 -> dist2 c z = ahead_of c u z * ahead_of c u z + beside c u z * beside c u z.
Proof.
  intros U. transitivity (dot u u * dist2 c z); [rewrite U; ring |]. unfold ahead_of, beside, dot, dist2. cbn. ring.
Qed.

(* Beyond a tangent one is outside; *)
Lemma beyond_tangent c u m z : dot u u = 1 -> 0 <= m -> m < ahead_of c u z -> m < dist c z.
Proof.
  intros U M H. apply Rsqr_incrst_0; [| exact M | apply dist_nonneg]. unfold Rsqr. rewrite dist_sq, (frame c u z U).
  pose proof (Rle_0_sqr (beside c u z)) as B. unfold Rsqr in B. nra.
Qed.

(* in a rectangle whose corners are in the disc one is inside. *)
Lemma within_rectangle c u m a b h z : dot u u = 1 -> 0 <= m -> a * a + h * h <= m * m -> b * b + h * h <= m * m ->
  a < ahead_of c u z < b -> - h < beside c u z < h -> dist c z < m.
Proof.
  intros U M A B X Y. apply Rsqr_incrst_0; [| apply dist_nonneg | exact M]. unfold Rsqr. rewrite dist_sq, (frame c u z U).
  set (x := ahead_of c u z) in *. set (y := beside c u z) in *. assert (y * y < h * h) by nra.
  assert (x * x <= a * a \/ x * x <= b * b) as [L | L]; [| lra | lra].
  destruct (Rle_or_lt 0 x); [right | left]; nra.
Qed.

(* Each point on its side: the pair is an edge. Sides are decided for each point separately, in two coordinates at right
   angles, so the chance of all is the product over points and coordinates. *)
Theorem sides_make_edge N q i j c m : 0 <= m ->
  (forall k, (k < N)%nat -> k <> i -> k <> j -> exists u, dot u u = 1 /\ m < ahead_of c u (q k)) ->
  (forall k, k = i \/ k = j -> exists u a b h, dot u u = 1 /\ a * a + h * h <= m * m /\ b * b + h * h <= m * m /\
    a < ahead_of c u (q k) < b /\ - h < beside c u (q k) < h) -> strict_edge N q i j.
Proof.
  intros M Out In.
  assert (I : forall k, k = i \/ k = j -> dist c (q k) < m).
  { intros k K. destruct (In k K) as (u & a & b & h & U & A & B & X & Y). now apply (within_rectangle c u m a b h). }
  apply enclosing_disc_gives_edge with c. intros k K Ki Kj. destruct (Out k K Ki Kj) as (u & U & H).
  pose proof (beyond_tangent c u m (q k) U M H). pose proof (I i (or_introl eq_refl)). pose proof (I j (or_intror eq_refl)).
  lra.
Qed.
