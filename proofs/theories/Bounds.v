(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Error bounds for the partial triangulation: where the true edges are, and how far the undecided region reaches. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation Disc PartialDisc Crossing.
Open Scope R_scope.

(* No two points of the rectangle are farther apart than d. *)
Definition diameter_le (B : rect) (d : R) : Prop := forall x y, inside x B -> inside y B -> dist x y <= d.

(* The straight graph of a choice: all segments of Delaunay edges. *)
Definition graph (N : nat) (p : nat -> point) (z : point) : Prop :=
  exists i j, (i < N)%nat /\ (j < N)%nat /\ i <> j /\ weak_edge N p i j /\ between z (p i) (p j).

(* The union of the partial edges of all possible pairs: the complement of T's second component. *)
Definition possible_region (N : nat) (B : sites) (z : point) : Prop :=
  exists i j, (i < N)%nat /\ (j < N)%nat /\ i <> j /\ possible N B i j /\ partial_edge (B i) (B j) z.

(* The true graph lies in the union, for every choice: so the measure of the union bounds the undecided area, and only
   points of the union count for the Hausdorff distance. *)
Theorem graph_in_region N B p z : choice N B p -> graph N p z -> possible_region N B z.
Proof.
  intros P [i [j [I [J [D [W Z]]]]]]. exists i, j. repeat split; try assumption.
  - apply possible_exact; [exact I | exact J |]. now exists p.
  - exists (p i), (p j). split; [now apply P |]. split; [now apply P | exact Z].
Qed.

(* A strictly Delaunay pair of distinct sites is an edge of the graph. *)
Lemma strict_is_weak N p i j : (i < N)%nat -> (j < N)%nat -> strict_edge N p i j -> weak_edge N p i j.
Proof.
  intros I J [c [E H]].
  assert (D : empty_disc N p (pair i j) c (dist c (p i))).
  { split.
    - intros k _ [-> | ->]; [reflexivity | now symmetry].
    - intros k K. destruct (Nat.eq_dec k i) as [-> | Di]; [lra |]. destruct (Nat.eq_dec k j) as [-> | Dj]; [lra |].
      pose proof (H k K Di Dj). lra. }
  left. destruct (Rle_lt_or_eq_dec 0 (dist c (p i)) (dist_nonneg _ _)) as [L | Z].
  - now exists c, (dist c (p i)).
  - rewrite <- Z in D. destruct (positive_disc N p _ c D) as [c' [r [R0 D']]]. now exists c', r.
Qed.

(* Points with the same ratio on two segments are no farther apart than the ends are. *)
Lemma dist_mixes t a b a' b' d : 0 <= t <= 1 -> dist a a' <= d -> dist b b' <= d -> dist (mix t a b) (mix t a' b') <= d.
Proof.
  intros T A H. set (o := (0, 0) : point).
  set (u := (fst a - fst a', snd a - snd a')). set (v := (fst b - fst b', snd b - snd b')).
  assert (E : forall x y : point, dist x y = dist o (fst x - fst y, snd x - snd y)).
  { intros x y. unfold dist, dist2, o. simpl. f_equal. ring. }
  rewrite (E a a') in A. rewrite (E b b') in H. rewrite E.
  replace (fst (mix t a b) - fst (mix t a' b'), snd (mix t a b) - snd (mix t a' b')) with (mix t u v)
    by (unfold mix, u, v; simpl; f_equal; ring).
  now apply disc_convex.
Qed.

(* T, Hausdorff, legal pairs: a point of the partial edge is within the larger diameter of the true edge. *)
Theorem legal_edge_near N B p i j z d : (i < N)%nat -> (j < N)%nat -> i <> j -> choice N B p -> legal N B i j ->
  diameter_le (B i) d -> diameter_le (B j) d -> partial_edge (B i) (B j) z ->
  exists w, graph N p w /\ dist z w <= d.
Proof.
  intros I J D P L Di Dj [x [y [X [Y [t [T ->]]]]]]. exists (mix t (p i) (p j)). split.
  - exists i, j. repeat split; try assumption.
    + apply strict_is_weak; [exact I | exact J |]. now apply (legal_sound N B i j p).
    + now exists t.
  - apply dist_mixes; [exact T | apply Di | apply Dj]; try assumption; now apply P.
Qed.

(* Every site is a vertex of the true graph: the pair of p i and a nearest other point is an edge. *)
Lemma nearest_neighbour_edge N p i : (i < N)%nat -> (2 <= N)%nat ->
  exists j, (j < N)%nat /\ j <> i /\ weak_edge N p i j.
Proof.
  intros I H2. destruct (finite_min (fun k => k <> i) (fun k => dist (p i) (p k)) N) as [j [J [D M]]].
  { destruct i; [exists 1%nat | exists 0%nat]; lia. }
  exists j. split; [exact J |]. split; [exact D |].
  set (c := mix (1 / 2) (p i) (p j)). set (r := dist (p i) (p j) / 2).
  assert (Ei : dist c (p i) = r). { rewrite dist_sym. unfold c. rewrite dist_mix_left by lra. unfold r. lra. }
  assert (Ej : dist c (p j) = r). { unfold c. rewrite dist_mix_right by lra. unfold r. lra. }
  assert (E : empty_disc N p (pair i j) c r).
  { split.
    - intros k _ [-> | ->]; assumption.
    - intros k K. destruct (Nat.eq_dec k i) as [-> | Dk]; [lra |]. pose proof (M k K Dk).
      pose proof (dist_triangle (p i) c (p k)). rewrite (dist_sym (p i) c) in *. unfold r in *. lra. }
  left. destruct (Rle_lt_or_eq_dec 0 r) as [L | Z]; [unfold r; pose proof (dist_nonneg (p i) (p j)); lra | |].
  - now exists c, r.
  - rewrite <- Z in E. destruct (positive_disc N p _ c E) as [c' [s [S0 E']]]. now exists c', s.
Qed.

(* T, Hausdorff, any pair: half the largest length of the pair and the larger diameter. *)
Theorem any_edge_near N B p i j z l d : (i < N)%nat -> (j < N)%nat -> i <> j -> choice N B p ->
  (forall x y, inside x (B i) -> inside y (B j) -> dist x y <= l) ->
  diameter_le (B i) d -> diameter_le (B j) d -> partial_edge (B i) (B j) z ->
  exists w, graph N p w /\ dist z w <= l / 2 + d.
Proof.
  intros I J D P Hl Di Dj [x [y [X [Y [t [T ->]]]]]].
  assert (G : forall k, (k < N)%nat -> graph N p (p k)).
  { intros k K. destruct (nearest_neighbour_edge N p k K) as [m [M [Dm W]]]; [lia |].
    exists k, m. repeat split; try assumption; [now apply not_eq_sym |]. exists 0. split; [lra | now rewrite mix_0]. }
  pose proof (Hl x y X Y) as Lxy. pose proof (dist_nonneg x y). destruct (Rle_dec t (1 / 2)) as [S | S].
  - exists (p i). split; [now apply G |]. pose proof (dist_triangle (mix t x y) x (p i)) as R1.
    rewrite (dist_sym (mix t x y) x), dist_mix_left in R1 by lra. pose proof (Di x (p i) X (P i I)). nra.
  - exists (p j). split; [now apply G |]. pose proof (dist_triangle (mix t x y) y (p j)) as R1.
    rewrite dist_mix_right in R1 by lra. pose proof (Dj y (p j) Y (P j J)). nra.
Qed.

(* T, Hausdorff: with h at least as large as these bounds of all possible pairs, the region is within h of every true
   graph, which is in the region. *)
Theorem triangulation_hausdorff N B p h : choice N B p ->
  (forall i j, (i < N)%nat -> (j < N)%nat -> i <> j -> possible N B i j ->
    exists d, diameter_le (B i) d /\ diameter_le (B j) d /\
      ((legal N B i j /\ d <= h) \/
       exists l, (forall x y, inside x (B i) -> inside y (B j) -> dist x y <= l) /\ l / 2 + d <= h)) ->
  (forall z, graph N p z -> possible_region N B z) /\
  (forall z, possible_region N B z -> exists w, graph N p w /\ dist z w <= h).
Proof.
  intros P H. split; [intros z; now apply graph_in_region |].
  intros z [i [j [I [J [D [Q Z]]]]]]. destruct (H i j I J D Q) as [d [Di [Dj [[L M] | [l [Hl M]]]]]].
  - destruct (legal_edge_near N B p i j z d I J D P L Di Dj Z) as [w [G W]]. exists w. split; [exact G | lra].
  - destruct (any_edge_near N B p i j z l d I J D P Hl Di Dj Z) as [w [G W]]. exists w. split; [exact G | lra].
Qed.

(* No true graph reaches outside of the region. *)
Corollary outside_region_is_free N B p z : choice N B p -> ~ possible_region N B z -> ~ graph N p z.
Proof. intros P H G. now apply H, graph_in_region with p. Qed.

(* More information leaves a smaller region: T is monotone. *)
Theorem region_monotone N B' B z : refined N B' B -> possible_region N B' z -> possible_region N B z.
Proof.
  intros F [i [j [I [J [D [P [x [y [X [Y Z]]]]]]]]]]. exists i, j. repeat split; try assumption.
  - now apply (possible_monotone N B' B).
  - exists x, y. split; [now apply (F i I) |]. split; [now apply (F j J) | exact Z].
Qed.
