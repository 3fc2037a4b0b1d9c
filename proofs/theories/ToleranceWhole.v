(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* How far all points may move before a triangulation changes [TOL-5], and how far each [TOL-6]. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation TiedFace Fan Triangulation Tolerance
  ToleranceStays.
Open Scope R_scope.

(* The height of z over the line from u to w, times its length. *)
Definition height (u w z : point) : R := orient u w z.

Lemma height_moves u w y z : Rabs (height u w y - height u w z) <= dist u w * dist y z.
Proof.
  pose proof (dot_moves (- (snd w - snd u), fst w - fst u) y z) as H.
  replace (dist (0, 0) (- (snd w - snd u), fst w - fst u)) with (dist u w) in H
    by (apply dist_eq; unfold dist2; simpl; ring).
  replace (height u w y - height u w z)
    with (dot (- (snd w - snd u), fst w - fst u) y - dot (- (snd w - snd u), fst w - fst u) z)
    by (unfold height, orient, dot; simpl; ring).
  exact H.
Qed.

(* Three points that move by less than half the height of v over uw leave v off the segment uw. *)
Lemma corner_stays u v w u' v' w' :
  2 * (dist u w * dist u u') < orient u v w -> 2 * (dist u w * dist v v') < orient u v w ->
  2 * (dist u w * dist w w') < orient u v w -> ~ between v' u' w'.
Proof.
  intros U V W [t [T E]]. pose proof (height_moves u w u' u) as Hu. pose proof (height_moves u w v' v) as Hv.
  pose proof (height_moves u w w' w) as Hw. rewrite (dist_sym u' u) in Hu. rewrite (dist_sym v' v) in Hv.
  rewrite (dist_sym w' w) in Hw. apply between_of_abs in Hu, Hv, Hw.
  assert (Zu : height u w u = 0) by (unfold height, orient; ring).
  assert (Zw : height u w w = 0) by (unfold height, orient; ring).
  assert (Zv : height u w v = - orient u v w) by (unfold height, orient; ring).
  assert (M : height u w v' = (1 - t) * height u w u' + t * height u w w').
  { rewrite E. unfold height, orient, mix. simpl. ring. }
  set (d := orient u v w) in *. assert (A : - (d / 2) < height u w u') by lra. assert (B : - (d / 2) < height u w w') by lra.
  assert (C : height u w v' < - (d / 2)) by lra.
  assert (0 <= (1 - t) * (height u w u' + d / 2)) by (apply Rmult_le_pos; lra).
  assert (0 <= t * (height u w w' + d / 2)) by (apply Rmult_le_pos; lra). lra.
Qed.

Lemma path_moves p q t k : 0 <= t <= 1 -> dist (p k) (path p q t k) <= dist (p k) (q k).
Proof. intros T. unfold path. rewrite dist_mix_left by lra. pose proof (dist_nonneg (p k) (q k)). nra. Qed.

Section Moves.
Variables (N : nat) (p q : nat -> point) (faces : nat -> list (nat * nat)) (rim edge : nat -> nat -> Prop).
Variable sk : skeleton N p faces rim edge.
Variable edge_sites : forall i j, edge i j -> (i < N)%nat /\ (j < N)%nat.

(* Three consecutive corners u, v, w of the hull for which uw is no edge: each point moves by less than half the distance
   of v to the line uw, which is orient u v w / |uw|. *)
Definition hull_corners_keep : Prop := forall u v w, rim u v -> rim v w -> edge u w \/
  forall k, k = u \/ k = v \/ k = w -> 2 * (dist (p u) (p w) * dist (p k) (q k)) < orient (p u) (p v) (p w).

Lemma corners_keep : hull_corners_keep -> (forall t i j, 0 <= t <= 1 -> edge i j -> strict_edge N (path p q t) i j) ->
  forall t u v w, 0 <= t <= 1 -> rim u v -> rim v w -> ~ between (path p q t v) (path p q t u) (path p q t w).
Proof.
  intros H E t u v w T Ruv Rvw. destruct (rim_sites _ _ _ _ _ sk u v Ruv) as [U [V [Duv _]]].
  destruct (rim_sites _ _ _ _ _ sk v w Rvw) as [_ [W [Dvw _]]].
  destruct (H u v w Ruv Rvw) as [Ed | M].
  - apply edge_is_free with N; auto.
  - assert (X : forall k, k = u \/ k = v \/ k = w ->
      2 * (dist (p u) (p w) * dist (p k) (path p q t k)) < orient (p u) (p v) (p w)).
    { intros k K. pose proof (M k K). pose proof (path_moves p q t k T). pose proof (dist_nonneg (p u) (p w)). nra. }
    apply (corner_stays (p u) (p v) (p w)); apply X; auto.
Qed.

(* A circle, or a line, with both ends of the edge on its inner side and all others outside, which nobody reaches. *)
Definition ring_keeps (i j : nat) (c : point) (m : R) : Prop :=
  dist c (p i) < m /\ dist c (p j) < m /\ (forall k, (k < N)%nat -> k <> i -> k <> j -> m < dist c (p k)) /\
  forall k, (k < N)%nat -> dist (p k) (q k) < Rabs (dist c (p k) - m).
Definition line_keeps (i j : nat) (u : point) (m : R) : Prop :=
  m < dot u (p i) /\ m < dot u (p j) /\ (forall k, (k < N)%nat -> k <> i -> k <> j -> dot u (p k) < m) /\
  forall k, (k < N)%nat -> dist (0, 0) u * dist (p k) (q k) < Rabs (dot u (p k) - m).

Lemma ring_edge i j c m t : (i < N)%nat -> (j < N)%nat -> 0 <= t <= 1 -> ring_keeps i j c m -> strict_edge N (path p q t) i j.
Proof.
  intros I J T [Ci [Cj [Ck H]]].
  assert (In : forall k, (k < N)%nat -> dist c (p k) < m -> dist c (path p q t k) < m).
  { intros k K L. pose proof (H k K) as X. pose proof (path_moves p q t k T).
    rewrite Rabs_left in X by lra. pose proof (dist_triangle c (p k) (path p q t k)). lra. }
  apply enclosing_disc_gives_edge with c. intros k K Di Dj. pose proof (In i I Ci). pose proof (In j J Cj).
  pose proof (Ck k K Di Dj). pose proof (H k K) as X. rewrite Rabs_right in X by lra.
  pose proof (path_moves p q t k T). pose proof (dist_triangle_rev c (p k) (path p q t k)). lra.
Qed.

Lemma line_edge i j u m t : (i < N)%nat -> (j < N)%nat -> 0 <= t <= 1 -> line_keeps i j u m -> strict_edge N (path p q t) i j.
Proof.
  intros I J T [Ui [Uj [Uk H]]]. set (x := path p q t).
  assert (Near : forall k, (k < N)%nat -> Rabs (dot u (x k) - dot u (p k)) < Rabs (dot u (p k) - m)).
  { intros k K. apply Rle_lt_trans with (2 := H k K). apply Rle_trans with (1 := dot_moves u (x k) (p k)).
    rewrite (dist_sym (x k)). apply Rmult_le_compat_l; [apply dist_nonneg | now apply path_moves]. }
  assert (In : forall k, (k < N)%nat -> m < dot u (p k) -> m < dot u (x k)).
  { intros k K L. pose proof (Near k K) as X. rewrite (Rabs_right (dot u (p k) - m)) in X by lra.
    apply Rabs_def2 in X. lra. }
  assert (Out : forall k, (k < N)%nat -> dot u (p k) < m -> dot u (x k) < m).
  { intros k K L. pose proof (Near k K) as X. rewrite (Rabs_left (dot u (p k) - m)) in X by lra.
    apply Rabs_def2 in X. lra. }
  set (B := fun k => at_point (x k)).
  apply (legal_sound N B i j x I J); [| apply at_points_choice].
  destruct (far_witness N B i j (0, 0) u I J) as [t0 F].
  - intros k K Di Dj.
    destruct (highest_spec u (B k)) as [Hk _]. destruct (lowest_spec u (B i)) as [Hi _]. destruct (lowest_spec u (B j)) as [Hj _].
    rewrite (proj2 (at_point_exact (x k)) _ Hk), (proj2 (at_point_exact (x i)) _ Hi), (proj2 (at_point_exact (x j)) _ Hj).
    pose proof (Out k K (Uk k K Di Dj)). pose proof (In i I Ui). pose proof (In j J Uj). lra.
  - eexists. apply (F (t0 + 1)). lra.
Qed.

(* All statuses are as they were. *)
Definition unchanged : Prop := (forall i j, edge i j -> strict_edge N q i j) /\
  forall a b, (a < N)%nat -> (b < N)%nat -> a <> b -> (forall i j, In (i, j) (faces a) -> b <> i /\ b <> j) ->
    ~ weak_edge N q a b.

(* [TOL-5] The whole: t is at most every death, and half the distance of every such corner. *)
Theorem whole_unchanged t : (forall i j, edge i j -> forall s, s < t -> exists c, disc_witness N p i j s c) ->
  (forall u v w, rim u v -> rim v w -> edge u w \/ 2 * (dist (p u) (p w) * t) <= orient (p u) (p v) (p w)) ->
  (forall k, (k < N)%nat -> dist (p k) (q k) < t) -> unchanged.
Proof.
  intros D C M.
  assert (E : forall s i j, 0 <= s <= 1 -> edge i j -> strict_edge N (path p q s) i j).
  { intros s i j S Ed. destruct (edge_sites i j Ed) as [I J].
    destruct (finite_max (fun _ => True) (fun k => dist (p k) (q k)) N) as [m [Hm [_ L]]]; [now exists i |].
    destruct (D i j Ed (dist (p m) (q m)) (M m Hm)) as [c W].
    apply (disc_witness_sound N p i j (dist (p m) (q m)) c); [exact I | exact J | exact W |].
    intros k K. apply Rle_trans with (1 := path_moves p q s k S). now apply L. }
  apply (nothing_changes N p q faces rim edge sk E). apply corners_keep; [| exact E].
  intros u v w Ruv Rvw. destruct (C u v w Ruv Rvw) as [Ed | H]; [now left | right].
  destruct (rim_sites _ _ _ _ _ sk u v Ruv) as [U [V [Duv _]]]. destruct (rim_sites _ _ _ _ _ sk v w Rvw) as [_ [W [Dvw _]]].
  assert (P : 0 < dist (p u) (p w)).
  { apply dist_pos. intros Z. destruct (E 0 u v ltac:(lra) ltac:(now apply (rim_sites _ _ _ _ _ sk))) as [o [_ F]].
    unfold path in F. pose proof (F w W (not_eq_sym (rim_turns _ _ _ _ _ sk u v w Ruv Rvw)) (not_eq_sym Dvw)) as L.
    rewrite !mix_0, Z in L. lra. }
  intros k K. assert (B : (k < N)%nat) by (destruct K as [-> | [-> | ->]]; assumption). pose proof (M k B). nra.
Qed.

(* [TOL-6] Each point: a circle or line of its own for every edge, which nobody reaches. *)
Theorem points_unchanged : (forall i j, edge i j -> (exists c m, ring_keeps i j c m) \/ (exists u m, line_keeps i j u m)) ->
  hull_corners_keep -> unchanged.
Proof.
  intros R C.
  assert (E : forall s i j, 0 <= s <= 1 -> edge i j -> strict_edge N (path p q s) i j).
  { intros s i j S Ed. destruct (edge_sites i j Ed) as [I J].
    destruct (R i j Ed) as [[c [m K]] | [u [m K]]]; [now apply ring_edge with c m | now apply line_edge with u m]. }
  apply (nothing_changes N p q faces rim edge sk E). now apply corners_keep.
Qed.
End Moves.
