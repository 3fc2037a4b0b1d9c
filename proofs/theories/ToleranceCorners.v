(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Births: where f is nowhere positive, some corner of the lines of any part of the sites, or an end, is as high as its
   supremum [TOL-3]. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Crossing TiedFace Tolerance ToleranceBirth.
Open Scope R_scope.

Section Pair.
Variables (N : nat) (p : nat -> point) (i j : nat).
Variable differ : p i <> p j.
Let room := room N p i j.
Let at_s := at_s p i j.
Let line_n := line_n p i j.

(* The line of k over s: the squared distance of p k less that of p i and p j. *)
Definition line (k : nat) (s : R) : R := line_m p i j k - 2 * line_n k * s.

(* The sites of S but i and j. *)
Definition other (S : nat -> Prop) (k : nat) : Prop := (k < N)%nat /\ S k /\ k <> i /\ k <> j.

(* k is lowest at s; another one with another slope is as low. *)
Definition lowest (S : nat -> Prop) (k : nat) (s : R) : Prop := other S k /\ forall l, other S l -> line k s <= line l s.
Definition corner (S : nat -> Prop) (s : R) : Prop := exists k l, lowest S k s /\ lowest S l s /\ line_n k <> line_n l.

Lemma as_far s : dist (at_s s) (p j) = dist (at_s s) (p i).
Proof. destruct (bisector_radius p i j s) as [A B]. apply dist_eq. unfold at_s. lra. Qed.

Lemma distance_by_line k s : dist2 (at_s s) (p k) = dist2 (at_s s) (p i) + line k s.
Proof. pose proof (bisector_line p i j s k) as L. unfold line, at_s, line_n. lra. Qed.

Lemma lower_is_nearer k l s : line k s <= line l s -> dist (at_s s) (p k) <= dist (at_s s) (p l).
Proof. intros H. apply dist_le. rewrite (distance_by_line k s), (distance_by_line l s). lra. Qed.

Lemma room_of_lowest S k s v : lowest S k s -> dist (at_s s) (p i) + v <= dist (at_s s) (p k) -> room S v (at_s s).
Proof.
  intros [_ Low] H l L Sl Di Dj. pose proof (lower_is_nearer k l s (Low l (conj L (conj Sl (conj Di Dj))))).
  rewrite (as_far s). lra.
Qed.

Lemma on_bisector t a b : at_s (a + t * (b - a)) = mix t (at_s a) (at_s b).
Proof. unfold at_s, Tolerance.at_s, mix. simpl. f_equal; ring. Qed.

(* Going to one side (1 or -1), the lowest line meets another one, or stays lowest all the way. *)
Lemma next_corner S k s0 side : side * side = 1 -> lowest S k s0 ->
  (exists x, 0 <= x /\ lowest S k (s0 + side * x) /\ corner S (s0 + side * x)) \/
  (forall l, other S l -> side * line_n l <= side * line_n k).
Proof.
  intros Q [Ok Low]. set (falls l := other S l /\ side * line_n k < side * line_n l).
  destruct (classic (exists l, (l < N)%nat /\ falls l)) as [E | Ne].
  - left. set (x l := (line l s0 - line k s0) / (2 * (side * line_n l - side * line_n k))).
    assert (Along : forall l y, line l (s0 + side * y) - line k (s0 + side * y) =
      line l s0 - line k s0 - 2 * (side * line_n l - side * line_n k) * y) by (intros l y; unfold line; ring).
    destruct (finite_min falls x N E) as [m [M [[Om Fm] Least]]]. exists (x m).
    assert (Xl : forall l, falls l -> 2 * (side * line_n l - side * line_n k) * x l = line l s0 - line k s0)
      by (intros l [_ F]; unfold x; field; lra).
    assert (X0 : 0 <= x m).
    { apply Rmult_le_pos; [pose proof (Low m Om); lra | left; apply Rinv_0_lt_compat; lra]. }
    assert (Lk : lowest S k (s0 + side * x m)).
    { split; [exact Ok |]. intros l Ol. pose proof (Along l (x m)) as A. pose proof (Low l Ol) as L0.
      destruct (Rle_dec (side * line_n l) (side * line_n k)) as [F | F].
      - assert (0 <= (side * line_n k - side * line_n l) * x m) by (apply Rmult_le_pos; lra). lra.
      - assert (Fl : falls l) by (split; [exact Ol | lra]). pose proof (Least l (proj1 Ol) Fl) as Y. pose proof (Xl l Fl).
        assert (0 <= 2 * (side * line_n l - side * line_n k) * (x l - x m)) by (apply Rmult_le_pos; lra). lra. }
    split; [exact X0 |]. split; [exact Lk |]. exists k, m. split; [exact Lk |]. split; [| intros Z; rewrite Z in Fm; lra].
    split; [exact Om |]. intros l Ol. pose proof (proj2 Lk l Ol). pose proof (Along m (x m)).
    pose proof (Xl m (conj Om Fm)). lra.
  - right. intros l Ol. apply Rnot_lt_le. intros F. apply Ne. exists l. split; [apply Ol | now split].
Qed.

(* Where one line's g is below v <= 0 is convex, so on one side of a place with g >= v it is not below v. *)
Lemma one_side k s0 v : v <= 0 -> dist (at_s s0) (p i) + v <= dist (at_s s0) (p k) ->
  exists side, side * side = 1 /\ forall x, 0 <= x ->
    dist (at_s (s0 + side * x)) (p i) + v <= dist (at_s (s0 + side * x)) (p k).
Proof.
  intros V H. apply NNPP. intros Ne.
  assert (Low : forall side, side * side = 1 -> exists x, 0 <= x /\
    dist (at_s (s0 + side * x)) (p k) < dist (at_s (s0 + side * x)) (p i) + v).
  { intros side Q. apply NNPP. intros F. apply Ne. exists side. split; [exact Q |]. intros x X. apply Rnot_lt_le. intros L.
    apply F. now exists x. }
  destruct (Low 1) as [x [X Lx]]; [ring |]. destruct (Low (-1)) as [y [Y Ly]]; [ring |].
  set (a := s0 + -1 * y) in *. set (b := s0 + 1 * x) in *.
  set (u := Rmin (dist (at_s a) (p i) - dist (at_s a) (p k)) (dist (at_s b) (p i) - dist (at_s b) (p k))).
  pose proof (Rmin_l (dist (at_s a) (p i) - dist (at_s a) (p k)) (dist (at_s b) (p i) - dist (at_s b) (p k))) as Ua.
  pose proof (Rmin_r (dist (at_s a) (p i) - dist (at_s a) (p k)) (dist (at_s b) (p i) - dist (at_s b) (p k))) as Ub.
  fold u in Ua, Ub. assert (U : - v < u) by (apply Rmin_glb_lt; lra).
  destruct (Req_dec (x + y) 0) as [Z | Z].
  - assert (b = s0) by (unfold b; lra). replace b with s0 in Lx. lra.
  - assert (I : 0 < / (x + y)) by (apply Rinv_0_lt_compat; lra).
    assert (M : s0 = a + y / (x + y) * (b - a)) by (unfold a, b; field; lra).
    assert (T : 0 <= y / (x + y) <= 1).
    { split; [apply Rmult_le_pos; lra |]. apply (Rmult_le_reg_r (x + y)); [lra |]. unfold Rdiv.
      rewrite Rmult_assoc, Rinv_l by lra. lra. }
    pose proof (nearer_by_convex u (y / (x + y)) (at_s a) (at_s b) (p k) (p i) ltac:(lra) T ltac:(lra) ltac:(lra)) as C.
    rewrite <- on_bisector, <- M in C. lra.
Qed.

(* All the way out the end has what the lowest line has. *)
Lemma end_of_lowest S k s0 side v : side * side = 1 -> (forall l, other S l -> side * line_n l <= side * line_n k) ->
  (forall x, 0 <= x -> dist (at_s (s0 + side * x)) (p i) + v <= dist (at_s (s0 + side * x)) (p k)) ->
  room_at_end N p i j S side v.
Proof.
  intros Q Steep Far l L Sl Di Dj. pose proof (dist_pos _ _ differ) as P. set (size := dist (p i) (p j)) in *.
  apply Rle_trans with (- side * (line_n k / size)).
  - apply Rnot_lt_le. intros Lt. set (e := (v - - side * (line_n k / size)) / 2).
    destruct (gap_at_end p i j differ k side e) as [x0 [X0 G]]; [unfold e; lra | exact Q |].
    set (x := x0 + Rabs s0). pose proof (Rabs_pos s0). pose proof (Rle_abs s0). pose proof (Rle_abs (- s0)) as B.
    rewrite Rabs_Ropp in B. assert (Sd : side = 1 \/ side = -1).
    { destruct (Rle_dec 0 side); [left | right]; nra. }
    assert (Xs : 0 <= x - side * s0) by (unfold x; destruct Sd as [-> | ->]; lra).
    pose proof (Far (x - side * s0) Xs) as F.
    replace (s0 + side * (x - side * s0)) with (side * x) in F
      by (transitivity (s0 * (1 - side * side) + side * x); [rewrite Q; ring | ring]).
    pose proof (G x ltac:(unfold x; lra)) as Y. apply between_of_abs in Y. fold size in Y.
    unfold at_s, line_n in *. unfold e in Y. lra.
  - pose proof (Steep l (conj L (conj Sl (conj Di Dj)))) as Y. assert (I : 0 < / size) by (now apply Rinv_0_lt_compat).
    unfold Rdiv. fold line_n. assert (0 <= (side * line_n k - side * line_n l) * / size) by (apply Rmult_le_pos; lra). lra.
Qed.

(* Nowhere positive: the supremum for all sites is no higher than a corner or an end of those of S. *)
Theorem best_corner_bounds S w : is_lub (rooms N p i j everybody) w -> w <= 0 -> (exists k, other S k) ->
  (exists s, corner S s /\ room S w (at_s s)) \/ room_at_end N p i j S 1 w \/ room_at_end N p i j S (-1) w.
Proof.
  intros W W0 [k0 O0].
  destruct (supremum_on_bisector N p i j differ everybody w W) as [[s0 R] | R].
  - destruct (finite_min (other S) (fun k => line k s0) N) as [k [K [Ok Low]]]; [exists k0; split; [apply O0 | exact O0] |].
    assert (Lk : lowest S k s0) by (split; [exact Ok |]; intros l Ol; now apply Low; [apply Ol |]).
    destruct Ok as [_ [Sk [Di Dj]]]. destruct (R k K Logic.I Di Dj) as [Rk _].
    destruct (one_side k s0 w W0 Rk) as [side [Q Far]].
    destruct (next_corner S k s0 side Q Lk) as [[x [X [Lx C]]] | Steep].
    + left. exists (s0 + side * x). split; [exact C |]. apply room_of_lowest with k; [exact Lx | now apply Far].
    + right. pose proof (end_of_lowest S k s0 side w Q Steep Far) as E.
      assert (Sd : side = 1 \/ side = -1) by (destruct (Rle_dec 0 side); [left | right]; nra).
      destruct Sd as [-> | ->]; [now left | now right].
  - right. destruct R as [R | R]; [left | right]; intros k K _ Di Dj; now apply R.
Qed.

(* Farther out: at an end at which no other site is nearer, that is the supremum for all. *)
Theorem others_enough_at_end S w side : side * side = 1 -> (forall v, rooms N p i j S v -> v <= w) ->
  room_at_end N p i j everybody side w -> is_lub (rooms N p i j everybody) w.
Proof.
  intros Q H R. split.
  - intros v [x X]. apply H. exists x. intros k K _ Di Dj. now apply X.
  - intros b B. apply Rnot_lt_le. intros L.
    pose proof (B _ (end_is_approached N p i j differ everybody side w ((w - b) / 2) ltac:(lra) Q R)). lra.
Qed.

(* A pair that is born up to t is possible for squares of that half-width. *)
Theorem born_in_squares w t B : (i < N)%nat -> (j < N)%nat -> is_lub (rooms N p i j everybody) w -> 0 <= t ->
  - w / 2 <= t -> (forall k z, (k < N)%nat -> Rabs (fst z - fst (p k)) <= t -> Rabs (snd z - snd (p k)) <= t ->
    inside z (B k)) -> possible N B i j.
Proof.
  intros I J W T L Sq. destruct (proj2 (birth_is_half N p i j I J differ w t W T) L) as [q [M E]].
  apply possible_exact; [exact I | exact J |]. exists q. split; [| exact E]. intros k K. pose proof (M k K) as D.
  assert (D2 : dist2 (p k) (q k) <= t * t) by (rewrite <- dist_sq; pose proof (dist_nonneg (p k) (q k)); nra).
  unfold dist2 in D2. pose proof (Rle_0_sqr (fst (p k) - fst (q k))) as X. pose proof (Rle_0_sqr (snd (p k) - snd (q k))) as Y.
  unfold Rsqr in X, Y. apply Sq; [exact K | |]; apply Rabs_le; split; nra.
Qed.
End Pair.
