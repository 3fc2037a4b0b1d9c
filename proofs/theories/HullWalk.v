(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Arcs of directions as the code makes them, and the walk that decides possible vertices of the hull [HUL-1] [HUL-2]. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Finite Distance Cells Nerve Orientation HullDirection.
Import ListNotations.
Open Scope R_scope.

(* ---- vectors ---- *)

Definition scale (t : R) (a : point) : point := (t * fst a, t * snd a).
Definition turned (a : point) : point := (- snd a, fst a).
Definition turned_back (a : point) : point := (snd a, - fst a).

Lemma cross_turned u a : cross u (turned a) = dot u a.
Proof. unfold cross, dot, turned. simpl. ring. Qed.
Lemma cross_turned_back u a : cross (turned_back a) u = dot u a.
Proof. unfold cross, dot, turned_back. simpl. ring. Qed.
Lemma cross_swap a b : cross a b = - cross b a.
Proof. unfold cross. ring. Qed.
Lemma cross_scale_l t a b : cross (scale t a) b = t * cross a b.
Proof. unfold cross, scale. simpl. ring. Qed.
Lemma cross_scale_r t a b : cross a (scale t b) = t * cross a b.
Proof. unfold cross, scale. simpl. ring. Qed.
Lemma three_crosses a b c u : cross a c * dot u b = cross a b * dot u c + cross b c * dot u a.
Proof. unfold cross, dot. ring. Qed.
Lemma four_crosses a b c d : cross a c * cross b d = cross a b * cross c d + cross a d * cross b c.
Proof. unfold cross. ring. Qed.

(* ---- the arc of directions that have a positive product with four corners, as arcs.c makes it ---- *)

(* The corners of K - V: K is the farther one. *)
Definition d00 (V K : rect) : point := (xlo K - xhi V, ylo K - yhi V).
Definition d10 (V K : rect) : point := (xhi K - xlo V, ylo K - yhi V).
Definition d01 (V K : rect) : point := (xlo K - xhi V, yhi K - ylo V).
Definition d11 (V K : rect) : point := (xhi K - xlo V, yhi K - ylo V).
Definition differs (V K : rect) (d : point) : Prop := d = d00 V K \/ d = d10 V K \/ d = d01 V K \/ d = d11 V K.

Theorem beyond_differences u V K : beyond u V K <-> forall d, differs V K d -> 0 < dot u d.
Proof.
  pose proof (x_ordered V). pose proof (y_ordered V). pose proof (x_ordered K). pose proof (y_ordered K). split.
  - intros H'. rewrite beyond_points in H'.
    assert (C : forall x y x' y', xlo V <= x <= xhi V -> ylo V <= y <= yhi V -> xlo K <= x' <= xhi K -> ylo K <= y' <= yhi K ->
      0 < dot u (x' - x, y' - y)).
    { intros x y x' y' X Y X' Y'. specialize (H' (x, y) (x', y') (conj X Y) (conj X' Y')). unfold dot in *. simpl in *. lra. }
    intros d [-> | [-> | [-> | ->]]]; apply C; lra.
  - intros H'. pose proof (H' _ (or_introl eq_refl)) as A. pose proof (H' _ (or_intror (or_introl eq_refl))) as B.
    pose proof (H' _ (or_intror (or_intror (or_introl eq_refl)))) as C.
    pose proof (H' _ (or_intror (or_intror (or_intror eq_refl)))) as D.
    unfold beyond, dot, highest, lowest, d00, d10, d01, d11 in *. simpl in *.
    destruct (Rle_dec 0 (fst u)); destruct (Rle_dec 0 (snd u)); simpl; lra.
Qed.

(* The code's loop over the corners: the first one counterclockwise, and the last. *)
Definition earlier (a b : point) : point := if Rlt_dec 0 (cross b a) then b else a.
Definition later (a b : point) : point := if Rlt_dec 0 (cross a b) then b else a.
Definition first_of (V K : rect) : point := earlier (earlier (earlier (d00 V K) (d10 V K)) (d01 V K)) (d11 V K).
Definition last_of (V K : rect) : point := later (later (later (d00 V K) (d10 V K)) (d01 V K)) (d11 V K).
Definition arc_to (V K : rect) : point := turned (first_of V K).
Definition arc_from (V K : rect) : point := turned_back (last_of V K).

Lemma order_trans u a b c : 0 < dot u a -> 0 < dot u b -> 0 < dot u c -> 0 <= cross a b -> 0 <= cross b c -> 0 <= cross a c.
Proof. intros A B C P Q. pose proof (three_crosses a b c u). apply Rnot_lt_le. intros F. nra. Qed.

Lemma earlier_spec u a b : 0 < dot u a -> 0 < dot u b ->
  0 < dot u (earlier a b) /\ 0 <= cross (earlier a b) a /\ 0 <= cross (earlier a b) b.
Proof.
  intros A B. assert (Z : forall x, cross x x = 0) by (intros; unfold cross; ring). unfold earlier.
  destruct (Rlt_dec 0 (cross b a)) as [L | L]; rewrite !Z; pose proof (cross_swap a b); repeat split; lra.
Qed.

Lemma later_spec u a b : 0 < dot u a -> 0 < dot u b ->
  0 < dot u (later a b) /\ 0 <= cross a (later a b) /\ 0 <= cross b (later a b).
Proof.
  intros A B. assert (Z : forall x, cross x x = 0) by (intros; unfold cross; ring). unfold later.
  destruct (Rlt_dec 0 (cross a b)) as [L | L]; rewrite !Z; pose proof (cross_swap a b); repeat split; lra.
Qed.

Lemma one_of_two (a b : point) : (earlier a b = a \/ earlier a b = b) /\ (later a b = a \/ later a b = b).
Proof. unfold earlier, later. destruct (Rlt_dec 0 (cross b a)); destruct (Rlt_dec 0 (cross a b)); tauto. Qed.

Lemma first_differs V K : differs V K (first_of V K).
Proof.
  unfold differs, first_of. set (a := d00 V K). set (b := d10 V K). set (c := d01 V K). set (d := d11 V K).
  destruct (proj1 (one_of_two (earlier (earlier a b) c) d)) as [-> | ->]; [| tauto].
  destruct (proj1 (one_of_two (earlier a b) c)) as [-> | ->]; [| tauto].
  destruct (proj1 (one_of_two a b)) as [-> | ->]; tauto.
Qed.

Lemma last_differs V K : differs V K (last_of V K).
Proof.
  unfold differs, last_of. set (a := d00 V K). set (b := d10 V K). set (c := d01 V K). set (d := d11 V K).
  destruct (proj2 (one_of_two (later (later a b) c) d)) as [-> | ->]; [| tauto].
  destruct (proj2 (one_of_two (later a b) c)) as [-> | ->]; [| tauto].
  destruct (proj2 (one_of_two a b)) as [-> | ->]; tauto.
Qed.

Lemma first_is_first u V K : beyond u V K -> forall d, differs V K d -> 0 <= cross (first_of V K) d.
Proof.
  rewrite beyond_differences. intros H. unfold first_of, differs in *.
  set (a := d00 V K) in *. set (b := d10 V K) in *. set (c := d01 V K) in *. set (e := d11 V K) in *.
  destruct (earlier_spec u a b) as [P1 [P2 P3]]; try (apply H; tauto). set (x := earlier a b) in *.
  destruct (earlier_spec u x c) as [Q1 [Q2 Q3]]; [exact P1 | apply H; tauto |]. set (y := earlier x c) in *.
  destruct (earlier_spec u y e) as [R1 [R2 R3]]; [exact Q1 | apply H; tauto |]. set (z := earlier y e) in *.
  assert (Zx : 0 <= cross z x) by (apply (order_trans u z y x); assumption).
  intros d [-> | [-> | [-> | ->]]].
  - apply (order_trans u z x a); try assumption. apply H. tauto.
  - apply (order_trans u z x b); try assumption. apply H. tauto.
  - apply (order_trans u z y c); try assumption. apply H. tauto.
  - exact R3.
Qed.

Lemma last_is_last u V K : beyond u V K -> forall d, differs V K d -> 0 <= cross d (last_of V K).
Proof.
  rewrite beyond_differences. intros H. unfold last_of, differs in *.
  set (a := d00 V K) in *. set (b := d10 V K) in *. set (c := d01 V K) in *. set (e := d11 V K) in *.
  destruct (later_spec u a b) as [P1 [P2 P3]]; try (apply H; tauto). set (x := later a b) in *.
  destruct (later_spec u x c) as [Q1 [Q2 Q3]]; [exact P1 | apply H; tauto |]. set (y := later x c) in *.
  destruct (later_spec u y e) as [R1 [R2 R3]]; [exact Q1 | apply H; tauto |]. set (z := later y e) in *.
  assert (Zx : 0 <= cross x z) by (apply (order_trans u x y z); assumption).
  intros d [-> | [-> | [-> | ->]]].
  - apply (order_trans u a x z); try assumption. apply H. tauto.
  - apply (order_trans u b x z); try assumption. apply H. tauto.
  - apply (order_trans u c y z); try assumption. apply H. tauto.
  - exact R3.
Qed.

(* An arc: counterclockwise, at most a half turn. *)
Definition is_arc (a b : point) : Prop := 0 < cross a b \/ (cross a b = 0 /\ dot a b < 0).
Definition in_arc (a b u : point) : Prop := 0 < cross a u /\ 0 < cross u b.

(* What arcs.c makes is an arc, and holds just the directions in which K is farther out than V. *)
Theorem arc_is_beyond V K : (exists w, beyond w V K) ->
  is_arc (arc_from V K) (arc_to V K) /\ forall u, in_arc (arc_from V K) (arc_to V K) u <-> beyond u V K.
Proof.
  intros [w W]. pose proof (first_is_first w V K W) as F. pose proof (last_is_last w V K W) as L.
  pose proof (first_differs V K) as Df. pose proof (last_differs V K) as Dl. rewrite beyond_differences in W.
  unfold arc_from, arc_to. set (f := first_of V K) in *. set (l := last_of V K) in *.
  clearbody f l. pose proof (F l Dl) as Q. pose proof (W f Df) as Wf. pose proof (W l Dl) as Wl.
  assert (S : cross f l = 0 -> 0 < dot f l).
  { intros E. destruct w as [w1 w2], f as [f1 f2], l as [l1 l2]. unfold cross, dot in *. simpl in *.
    assert (I : (w1 * f1 + w2 * f2) * (l1 * l1 + l2 * l2) = (w1 * l1 + w2 * l2) * (f1 * l1 + f2 * l2) +
      (f1 * l2 - f2 * l1) * (w1 * l2 - w2 * l1)) by ring. rewrite E in I.
    assert (0 < l1 * l1 + l2 * l2).
    { apply Rnot_le_lt. intros N. assert (l1 = 0) by nra. assert (l2 = 0) by nra. subst. lra. }
    apply Rnot_le_lt. intros N. nra. }
  split.
  - unfold is_arc. assert (Ec : cross (turned_back l) (turned f) = cross f l) by (unfold cross, turned, turned_back; simpl; ring).
    assert (Ed : dot (turned_back l) (turned f) = - dot f l) by (unfold dot, turned, turned_back; simpl; ring).
    rewrite Ec, Ed. destruct (Rle_lt_or_eq_dec _ _ Q) as [G | G]; [now left | right]. symmetry in G. specialize (S G). lra.
  - intros u. unfold in_arc. rewrite cross_turned_back, cross_turned, beyond_differences. split.
    + intros [A B] d D. pose proof (F d D) as Fd. pose proof (L d D) as Ld. pose proof (W d D) as Wd.
      pose proof (three_crosses f d l u) as T. pose proof (three_crosses f d l w) as Tw.
      destruct (Rle_lt_or_eq_dec _ _ Q) as [G | G].
      * assert (0 < cross f d * dot u l + cross d l * dot u f); [| nra].
        assert (0 < cross f d \/ 0 < cross d l).
        { destruct (Rle_lt_or_eq_dec _ _ Fd) as [|E]; [now left |]. destruct (Rle_lt_or_eq_dec _ _ Ld) as [|E']; [now right |].
          exfalso. rewrite <- E, <- E' in Tw. nra. }
        pose proof (Rmult_le_pos _ _ Fd (Rlt_le _ _ A)). pose proof (Rmult_le_pos _ _ Ld (Rlt_le _ _ B)).
        destruct H as [H | H]; [pose proof (Rmult_lt_0_compat _ _ H A) | pose proof (Rmult_lt_0_compat _ _ H B)]; lra.
      * (* first and last have one direction: so has d *)
        assert (E : cross f d = 0) by (rewrite <- G in Tw; nra).
        destruct u as [u1 u2], w as [w1 w2], f as [f1 f2], d as [e1 e2]. unfold cross, dot in *. simpl in *.
        assert (I : (w1 * e1 + w2 * e2) * (u1 * f1 + u2 * f2) = (u1 * e1 + u2 * e2) * (w1 * f1 + w2 * f2)).
        { apply Rminus_diag_uniq. replace (_ - _) with ((f1 * e2 - f2 * e1) * (w2 * u1 - w1 * u2)) by ring. rewrite E. ring. }
        apply Rnot_le_lt. intros N. pose proof (Rmult_lt_0_compat _ _ Wd B). nra.
    + intros H. split; apply H; assumption.
Qed.

(* The code tests that no arc exists: K - V holds 0, or else a direction exists. *)
Definition no_arc (V K : rect) : Prop := xlo K - xhi V <= 0 <= xhi K - xlo V /\ ylo K - yhi V <= 0 <= yhi K - ylo V.

Theorem no_arc_exact V K : no_arc V K <-> ~ exists u, beyond u V K.
Proof.
  pose proof (x_ordered V). pose proof (y_ordered V). pose proof (x_ordered K). pose proof (y_ordered K). split.
  - intros [X Y] [u U]. rewrite beyond_differences in U.
    pose proof (U _ (or_introl eq_refl)) as A. pose proof (U _ (or_intror (or_introl eq_refl))) as B.
    pose proof (U _ (or_intror (or_intror (or_introl eq_refl)))) as C.
    pose proof (U _ (or_intror (or_intror (or_intror eq_refl)))) as D.
    unfold dot, d00, d10, d01, d11 in *. simpl in *. destruct (Rle_dec 0 (fst u)); destruct (Rle_dec 0 (snd u)); nra.
  - intros N. unfold no_arc. repeat split; apply Rnot_lt_le; intros L; apply N;
      [exists (1, 0) | exists (-1, 0) | exists (0, 1) | exists (0, -1)]; apply beyond_differences;
      intros d [-> | [-> | [-> | ->]]]; unfold dot, d00, d10, d01, d11; simpl; lra.
Qed.

(* ---- possible vertices: the walk ---- *)

(* Directions counterclockwise from (1,0): those of the upper half, (1,0) with them, before those of the lower one. *)
Definition upper (a : point) : Prop := 0 < snd a \/ (snd a = 0 /\ 0 < fst a).
Definition before (a b : point) : Prop := (upper a /\ ~ upper b) \/ ((upper a <-> upper b) /\ 0 < cross a b).

Lemma upper_dec a : upper a \/ ~ upper a.
Proof. apply classic. Qed.

Lemma not_upper a : a <> (0, 0) -> ~ upper a -> snd a < 0 \/ (snd a = 0 /\ fst a < 0).
Proof.
  intros Z U. unfold upper in U. destruct (Rtotal_order (snd a) 0) as [L | [E | G]]; [now left | right | exfalso; tauto].
  split; [exact E |]. destruct (Rtotal_order (fst a) 0) as [L | [E' | G]]; [exact L | exfalso; apply Z | exfalso; tauto].
  destruct a. simpl in *. now subst.
Qed.

Lemma before_irrefl a : ~ before a a.
Proof. intros [[A B] | [_ C]]; [tauto |]. unfold cross in C. lra. Qed.

(* In one half the order is that of the cross product, which is transitive there. *)
Lemma half_trans a b c : (upper a /\ upper b /\ upper c) \/ (snd a <= 0 /\ snd b <= 0 /\ snd c <= 0 /\
  (snd a = 0 -> fst a < 0) /\ (snd b = 0 -> fst b < 0) /\ (snd c = 0 -> fst c < 0)) -> 0 < cross a b -> 0 < cross b c -> 0 < cross a c.
Proof.
  unfold upper, cross. destruct a as [a1 a2], b as [b1 b2], c as [c1 c2]. simpl. intros H P Q.
  assert (E : (a1 * c2 - a2 * c1) * b2 = (a1 * b2 - a2 * b1) * c2 + (b1 * c2 - b2 * c1) * a2) by ring.
  destruct H as [[A [B C]] | [A [B [C [Za [Zb Zc]]]]]].
  - destruct B as [B | [B B1]].
    + apply Rnot_le_lt. intros N. destruct A as [A | [A A1]]; destruct C as [C | [C C1]]; subst; nra.
    + subst. destruct A as [A | [A A1]]; subst; nra.
  - destruct (Rle_lt_or_eq_dec _ _ B) as [B' | B'].
    + apply Rnot_le_lt. intros N. destruct (Rle_lt_or_eq_dec _ _ A) as [A' | A']; destruct (Rle_lt_or_eq_dec _ _ C) as [C' | C'];
        try specialize (Za A'); try specialize (Zc C'); subst; nra.
    + specialize (Zb B'). subst. destruct (Rle_lt_or_eq_dec _ _ A) as [A' | A']; try specialize (Za A'); subst; nra.
Qed.

Lemma before_trans a b c : a <> (0, 0) -> b <> (0, 0) -> c <> (0, 0) -> before a b -> before b c -> before a c.
Proof.
  intros Za Zb Zc [[A B] | [E C]] [[A' B'] | [E' C']]; try tauto; try (left; tauto).
  right. split; [tauto |]. apply half_trans with b; try assumption.
  destruct (upper_dec a) as [U | U]; [left; tauto | right].
  destruct (not_upper a Za U); destruct (not_upper b Zb ltac:(tauto)); destruct (not_upper c Zc ltac:(tauto)); repeat split; lra.
Qed.

(* A step from u to v, less than a half turn: if it does not pass (1,0), v comes later, and any direction between
   is in the step; *)
Lemma step_is_later u v : u <> (0, 0) -> v <> (0, 0) -> 0 < cross u v -> ~ passes u v -> before u v.
Proof.
  intros Zu Zv C N. destruct (upper_dec u) as [U | U]; destruct (upper_dec v) as [V | V].
  - right. tauto.
  - left. tauto.
  - exfalso. apply N. pose proof (not_upper u Zu U). unfold upper, passes, cross in *. simpl.
    destruct u as [u1 u2], v as [v1 v2]. simpl in *. destruct V as [V | [V V1]]; destruct H as [H | [H H1]]; subst; split; nra.
  - right. tauto.
Qed.

Lemma between_is_in_step u v w : u <> (0, 0) -> v <> (0, 0) -> w <> (0, 0) -> 0 < cross u v -> ~ before w u -> before w v ->
  in_step u v w.
Proof.
  intros Zu Zv Zw C N B. unfold before in *. unfold in_step.
  destruct (upper_dec u) as [U | U]; destruct (upper_dec v) as [V | V]; destruct (upper_dec w) as [W | W]; try tauto.
  - split; [| tauto]. apply Rnot_lt_le. intros L. apply N. right. rewrite cross_swap. split; [tauto | lra].
  - (* u, w above, v below *)
    assert (0 <= cross u w) as A by (apply Rnot_lt_le; intros L; apply N; right; rewrite cross_swap; split; [tauto | lra]).
    split; [exact A |]. pose proof (not_upper v Zv V) as Lv. unfold upper, cross in *.
    destruct u as [u1 u2], v as [v1 v2], w as [w1 w2]. simpl in *.
    assert (E : (w1 * v2 - w2 * v1) * u2 = (u1 * v2 - u2 * v1) * w2 - v2 * (u1 * w2 - u2 * w1)) by ring.
    apply Rnot_le_lt. intros L. destruct U as [U | [U U1]]; destruct W as [W | [W W1]]; destruct Lv as [Lv | [Lv Lv1]]; subst; nra.
  - (* u above, v, w below *)
    assert (0 < cross w v) as D by tauto. split; [| exact D]. pose proof (not_upper v Zv V) as Lv. pose proof (not_upper w Zw W) as Lw.
    unfold upper, cross in *. destruct u as [u1 u2], v as [v1 v2], w as [w1 w2]. simpl in *.
    assert (E : (u1 * w2 - u2 * w1) * v2 = (u1 * v2 - u2 * v1) * w2 - u2 * (w1 * v2 - w2 * v1)) by ring.
    apply Rnot_lt_le. intros L. destruct U as [U | [U U1]]; destruct Lw as [Lw | [Lw Lw1]]; destruct Lv as [Lv | [Lv Lv1]]; subst; nra.
  - split; [| tauto]. apply Rnot_lt_le. intros L. apply N. right. rewrite cross_swap. split; [tauto | lra].
Qed.

(* if it does, all that come after u are in it. *)
Lemma after_is_in_step u v w : u <> (0, 0) -> w <> (0, 0) -> 0 < cross u v -> passes u v -> ~ before w u -> in_step u v w.
Proof.
  intros Zu Zw C P N. unfold passes, before, in_step in *.
  destruct (upper_dec u) as [U | U].
  - exfalso. unfold upper, cross in *. destruct u as [u1 u2]. simpl in *. lra.
  - destruct (upper_dec w) as [W | W]; [tauto |].
    assert (0 <= cross u w) as A by (apply Rnot_lt_le; intros L; apply N; right; rewrite cross_swap; split; [tauto | lra]).
    split; [exact A |]. pose proof (not_upper u Zu U) as Lu. pose proof (not_upper w Zw W) as Lw. unfold cross in *.
    destruct u as [u1 u2], v as [v1 v2], w as [w1 w2]. simpl in *.
    assert (E : (w1 * v2 - w2 * v1) * u2 = (u1 * v2 - u2 * v1) * w2 - v2 * (u1 * w2 - u2 * w1)) by ring.
    apply Rnot_le_lt. intros L. destruct Lw as [Lw | [Lw Lw1]]; nra.
Qed.

Section Walk.
Variables (N : nat) (B : sites) (v : nat).
Let forbids (k : nat) (u : point) : Prop := beyond u (B v) (B k).
Let end_of (k : nat) : point := arc_to (B v) (B k).

Lemma step_end k u : forbids k u -> 0 < cross u (end_of k) /\ end_of k <> (0, 0) /\
  forall w, in_step u (end_of k) w -> forbids k w.
Proof.
  intros H. unfold forbids, end_of, arc_to in *. pose proof (first_is_first u _ _ H) as F. pose proof (first_differs (B v) (B k)) as D.
  pose proof (proj1 (beyond_differences _ _ _) H) as W. set (f := first_of (B v) (B k)) in *. clearbody f.
  assert (C : 0 < cross u (turned f)) by (rewrite cross_turned; now apply W). split; [exact C |]. split.
  - intros E. rewrite E in C. unfold cross in C. simpl in C. lra.
  - intros w [P Q]. apply beyond_differences. intros d Dd. pose proof (F d Dd) as Fd. pose proof (W d Dd) as Wd.
    pose proof (four_crosses u w (turned f) (turned d)) as E.
    assert (Et : cross (turned f) (turned d) = cross f d) by (unfold cross, turned; simpl; ring).
    rewrite Et in E. rewrite !cross_turned in *.
    pose proof (Rmult_lt_0_compat _ _ Q Wd). pose proof (Rmult_le_pos _ _ P Fd). apply Rnot_le_lt. intros L. nra.
Qed.

(* The walk: from (1,0), while a site forbids the place, to the end of its arc, until the start is passed. *)
Inductive walk : list nat -> point -> Prop :=
| walk_start : walk [] (1, 0)
| walk_step l u k : walk l u -> (k < N)%nat -> forbids k u -> ~ passes u (end_of k) -> walk (k :: l) (end_of k).

Lemma walk_place l u : walk l u -> u <> (0, 0).
Proof.
  intros H. destruct H as [| l u k _ _ Fk _]; [intros E; injection E; lra |]. exact (proj1 (proj2 (step_end k u Fk))).
Qed.

Lemma walk_behind l u : walk l u -> forall w, w <> (0, 0) -> before w u -> exists k, (k < N)%nat /\ forbids k w.
Proof.
  intros H. induction H as [| l u k W IH K Fk P]; intros w Z Q.
  - exfalso. destruct Q as [[A C] | [A C]]; unfold upper, cross in *; simpl in *; [apply C; right; lra |].
    assert (U : 0 < snd w \/ snd w = 0 /\ 0 < fst w) by (apply A; right; lra). lra.
  - destruct (classic (before w u)) as [L | L]; [now apply IH |]. exists k. split; [exact K |].
    destruct (step_end k u Fk) as [C [Ze S]]. apply S. apply between_is_in_step; try assumption. exact (walk_place l u W).
Qed.

(* Who was found is never found again, so there are at most N steps. *)
Lemma walk_ends_before l u : walk l u -> forall k, In k l -> end_of k = u \/ before (end_of k) u.
Proof.
  intros H. induction H as [| l u k W IH K Fk P]; intros m M; [destruct M |].
  destruct M as [<- | M]; [now left | right]. destruct (step_end k u Fk) as [C [Ze _]].
  pose proof (step_is_later u (end_of k) (walk_place l u W) Ze C P) as L.
  destruct (IH m M) as [E | E]; [now rewrite E |]. apply before_trans with u; try assumption; [| exact (walk_place l u W)].
  intros E'. rewrite E' in E. destruct E as [[[A | A] _] | [_ A]]; unfold cross in A; simpl in A; lra.
Qed.

Theorem walk_is_short l u : walk l u -> NoDup l /\ (length l <= N)%nat.
Proof.
  intros H. assert (G : NoDup l /\ forall k, In k l -> (k < N)%nat).
  { induction H as [| l u k W IH K Fk P]; [split; [constructor | intros k []] |]. destruct IH as [D I]. split.
    - constructor; [| exact D]. intros M. destruct (step_end k u Fk) as [C [Ze _]].
      pose proof (step_is_later u (end_of k) (walk_place l u W) Ze C P) as L.
      destruct (walk_ends_before l u W k M) as [E | E].
      + rewrite E in L. exact (before_irrefl u L).
      + apply (before_irrefl u). apply before_trans with (end_of k); try assumption; exact (walk_place l u W).
    - intros m [<- | M]; [exact K | now apply I]. }
  destruct G as [D I]. split; [exact D |]. rewrite <- (seq_length N 0). apply NoDup_incl_length; [exact D |].
  intros k M. apply in_seq. specialize (I k M). lia.
Qed.

(* Where it stops: a place that no site forbids, or everything is forbidden. *)
Theorem walk_decides l u : (v < N)%nat -> walk l u ->
  let hull := exists p w m, choice N B p /\ w <> (0, 0) /\ dot w (p v) = m /\ forall k, (k < N)%nat -> dot w (p k) <= m in
  ((forall k, (k < N)%nat -> ~ forbids k u) -> hull) /\
  (forall k, (k < N)%nat -> forbids k u -> passes u (end_of k) -> ~ hull).
Proof.
  intros V W hull. split.
  - intros H. apply (possible_vertex N B v V). exists u. split; [exact (walk_place l u W) | exact H].
  - intros k K Fk P H. apply (possible_vertex N B v V) in H. destruct H as [w [Z H]].
    destruct (classic (before w u)) as [L | L].
    + destruct (walk_behind l u W w Z L) as [m [M F]]. exact (H m M F).
    + destruct (step_end k u Fk) as [C [Ze S]]. apply (H k K). apply S.
      apply after_is_in_step; try assumption. exact (walk_place l u W).
Qed.
End Walk.
