(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* How far all points may move before a triangulation changes [TOL-5], and how far each [TOL-6]: with ties, too. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation Path TiedFace Fan Triangulation Tolerance
  ToleranceStays ToleranceTies.
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
Variable different : forall k l, (k < N)%nat -> (l < N)%nat -> k <> l -> p k <> p l.

(* An edge of the triangulation is strictly Delaunay, or drawn in an undecided face: no site is inside of a circle
   through its ends and a third site, and each site on it stays at its place. *)
Definition edges_drawn : Prop := forall i j, edge i j -> (i < N)%nat /\ (j < N)%nat /\ i <> j /\
  (strict_edge N p i j \/ exists o r, staying_circle N p q o r /\ dist o (p i) = r /\ dist o (p j) = r).

(* Three consecutive corners u, v, w of the hull: they are on one line, an undecided face, and stay at their places; or uw
   is an edge; or each moves by less than half the distance of v to the line uw, which is orient u v w / |uw|. *)
Definition hull_corners_keep : Prop := forall u v w, rim u v -> rim v w ->
  flat p q u v w \/ edge u w \/
  forall k, k = u \/ k = v \/ k = w -> 2 * (dist (p u) (p w) * dist (p k) (q k)) < orient (p u) (p v) (p w).

Definition edges_stay (q : nat -> point) : Prop := forall i j, (i < N)%nat -> (j < N)%nat -> i <> j ->
  strict_edge N p i j -> forall t, 0 <= t <= 1 -> strict_edge N (path p q t) i j.

(* Or else the middle one never comes between the others. *)
Definition hull_corners_free : Prop := forall u v w, rim u v -> rim v w ->
  flat p q u v w \/ edge u w \/
  forall t, 0 <= t <= 1 -> ~ between (path p q t v) (path p q t u) (path p q t w).

Lemma corners_free : edges_drawn -> edges_stay q -> hull_corners_free -> forall u v w, rim u v -> rim v w ->
  flat p q u v w \/ forall t, 0 <= t <= 1 -> ~ between (path p q t v) (path p q t u) (path p q t w).
Proof.
  intros D E H u v w Ruv Rvw. destruct (rim_sites _ _ _ _ _ sk u v Ruv) as [U [V [Duv _]]].
  destruct (rim_sites _ _ _ _ _ sk v w Rvw) as [_ [W [Dvw _]]].
  destruct (H u v w Ruv Rvw) as [Fl | [Ed | M]]; [now left | right | now right]. intros t T.
  apply (edges_are_free N p q edge different E (staying_circle N p q) (fun _ _ X => X) D); auto.
Qed.

Lemma keep_free : hull_corners_keep -> hull_corners_free.
Proof.
  intros H u v w Ruv Rvw. destruct (H u v w Ruv Rvw) as [Fl | [Ed | M]]; [now left | right; now left |]. do 2 right.
  intros t T.
  assert (X : forall k, k = u \/ k = v \/ k = w ->
    2 * (dist (p u) (p w) * dist (p k) (path p q t k)) < orient (p u) (p v) (p w)).
  { intros k K. pose proof (M k K). pose proof (path_moves p q t k T). pose proof (dist_nonneg (p u) (p w)). nra. }
  apply (corner_stays (p u) (p v) (p w)); apply X; auto.
Qed.

(* The same for no motion at all. *)
Lemma no_motion t k : path p p t k = p k.
Proof. now apply stays_at. Qed.

Lemma strict_edge_same z z' i j : (forall k, z k = z' k) -> strict_edge N z i j -> strict_edge N z' i j.
Proof. intros E [o [A H]]. exists o. rewrite <- !E. split; [exact A |]. intros k. rewrite <- E. apply H. Qed.

Lemma circle_still o r : staying_circle N p q o r -> staying_circle N p p o r.
Proof. intros [Out [_ C]]. split; [exact Out |]. split; [now intros | exact C]. Qed.

Lemma still_stay : edges_stay p.
Proof. intros i j I J D E t T. apply (strict_edge_same p); [intros k; symmetry; apply no_motion | exact E]. Qed.

Lemma corners_still : edges_drawn -> edges_stay q -> hull_corners_free -> forall u v w, rim u v -> rim v w ->
  flat p p u v w \/ forall t, 0 <= t <= 1 -> ~ between (path p p t v) (path p p t u) (path p p t w).
Proof.
  intros D E H u v w R R'. destruct (corners_free D E H u v w R R') as [[Z _] | F]; [left; now repeat split | right].
  intros t T. rewrite !no_motion. pose proof (F 0 ltac:(lra)) as X. now rewrite !path_0 in X.
Qed.

(* While no strictly Delaunay edge is lost, every pair keeps its status. *)
Theorem statuses_stay : edges_drawn -> edges_stay q -> hull_corners_free ->
  forall a b, (a < N)%nat -> (b < N)%nat -> a <> b -> same_status N p q a b.
Proof.
  intros D E H a b A B Dab. pose proof (corners_free D E H) as C.
  set (tied := staying_circle N p q). assert (Tq : forall o r, tied o r -> staying_circle N p q o r) by (intros o r X; exact X).
  destruct (classic (strict_edge N p a b)) as [Sp | Np].
  - assert (Sq : strict_edge N q a b).
    { apply (strict_edge_same (path p q 1)); [intros k; apply mix_1 |]. apply E; auto. lra. }
    pose proof (strict_is_weak N p a b A B Sp). pose proof (strict_is_weak N q a b A B Sq). split; split; intros; assumption.
  - destruct (classic (exists o r, staying_circle N p q o r /\ dist o (p a) = r /\ dist o (p b) = r))
      as [[o [r [Cr [Oa Ob]]]] | Nc].
    { now apply (circle_pair N p q different E o r). }
    destruct (classic (exists u v, rim u v /\ on_side_line p q u v a /\ on_side_line p q u v b))
      as [[u [v [R [La Lb]]]] | Nl].
    { now apply (line_pair N p q faces rim edge sk different E tied Tq D C u v). }
    assert (Nt : forall o r, tied o r -> ~ (dist o (p a) = r /\ dist o (p b) = r))
      by (intros o r Cr [Oa Ob]; apply Nc; now exists o, r).
    assert (Wq : ~ weak_edge N q a b).
    { apply (other_pair N p q faces rim edge sk different E tied Tq D C a b A B Dab Np Nt).
      intros u v R [La Lb]. apply Nl. now exists u, v. }
    assert (Wp : ~ weak_edge N p a b).
    { apply (other_pair N p p faces rim edge sk different still_stay tied (fun o r X => circle_still o r X) D
        (corners_still D E H) a b A B Dab Np Nt).
      assert (Line : forall u v k, rim u v -> (k < N)%nat -> on_side_line p p u v k -> on_side_line p q u v k).
      { intros u v k R K L. destruct (Nat.eq_dec k u) as [-> | Du]; [now left |].
        destruct (Nat.eq_dec k v) as [-> | Dv]; [right; now left |]. destruct L as [L | [L | [Z _]]]; try contradiction.
        destruct (rim_at_first N p q faces rim edge sk (edges_are_free N p q edge different E tied Tq D) C u v k R K Du Dv)
          as [P | Fl]; [rewrite !path_0 in P; lra | right; now right]. }
      intros u v R [La Lb]. apply Nl. exists u, v. split; [exact R |]. split; now apply Line. }
    split; split; intros X; try contradiction.
    exfalso. apply Wq. now apply strict_is_weak.
Qed.

(* A circle, or a line, with both ends of the edge on its inner side and all others outside, which no site reaches. *)
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

(* [TOL-5] The whole: t is at most every death, and half the distance of every such corner; ties do not occur. *)
Theorem whole_unchanged t : (forall i j, edge i j -> (i < N)%nat /\ (j < N)%nat /\ i <> j /\ strict_edge N p i j) ->
  (forall i j, (i < N)%nat -> (j < N)%nat -> i <> j -> strict_edge N p i j ->
    forall s, s < t -> exists c, disc_witness N p i j s c) ->
  (forall u v w, rim u v -> rim v w -> edge u w \/ 2 * (dist (p u) (p w) * t) <= orient (p u) (p v) (p w)) ->
  (forall k, (k < N)%nat -> dist (p k) (q k) < t) ->
  forall a b, (a < N)%nat -> (b < N)%nat -> a <> b -> same_status N p q a b.
Proof.
  intros Strict D C M. apply statuses_stay; [| | apply keep_free].
  - intros i j E. destruct (Strict i j E) as [I [J [Dij St]]]. repeat split; auto.
  - intros i j I J Dij St s S.
    destruct (finite_max (fun _ => True) (fun k => dist (p k) (q k)) N) as [m [Hm [_ L]]]; [now exists i |].
    destruct (D i j I J Dij St (dist (p m) (q m)) (M m Hm)) as [c W].
    apply (disc_witness_sound N p i j (dist (p m) (q m)) c); [exact I | exact J | exact W |].
    intros k K. apply Rle_trans with (1 := path_moves p q s k S). now apply L.
  - intros u v w Ruv Rvw. right. destruct (C u v w Ruv Rvw) as [Ed | H]; [now left | right].
    destruct (rim_sites _ _ _ _ _ sk u v Ruv) as [U [V _]]. destruct (rim_sites _ _ _ _ _ sk v w Rvw) as [_ [W _]].
    pose proof (dist_pos _ _ (different u w U W (rim_turns _ _ _ _ _ sk u v w Ruv Rvw))).
    intros k K. assert (B : (k < N)%nat) by (destruct K as [-> | [-> | ->]]; assumption). pose proof (M k B). nra.
Qed.

(* [TOL-6] Each point: a circle or line of its own for every strictly Delaunay edge, which no site reaches. *)
Theorem points_unchanged : edges_drawn ->
  (forall i j, (i < N)%nat -> (j < N)%nat -> i <> j -> strict_edge N p i j ->
    (exists c m, ring_keeps i j c m) \/ (exists u m, line_keeps i j u m)) -> hull_corners_keep ->
  forall a b, (a < N)%nat -> (b < N)%nat -> a <> b -> same_status N p q a b.
Proof.
  intros D R H. apply statuses_stay; [exact D | | now apply keep_free]. intros i j I J Dij St s S.
  destruct (R i j I J Dij St) as [[c [m K]] | [u [m K]]]; [now apply ring_edge with c m | now apply line_edge with u m].
Qed.
End Moves.
