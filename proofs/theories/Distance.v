(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Rectangles, and the smallest and largest distance from a point to a rectangle. *)
From Coq Require Import Reals Lra Psatz.
From Dyadel Require Import Plane.
Open Scope R_scope.

(* A closed rectangle [xlo,xhi] x [ylo,yhi]; zero width is allowed. *)
Record rect : Type := Rect {
  xlo : R; xhi : R; ylo : R; yhi : R;
  x_ordered : xlo <= xhi;
  y_ordered : ylo <= yhi }.

Definition inside (z : point) (B : rect) : Prop :=
  xlo B <= fst z <= xhi B /\ ylo B <= snd z <= yhi B.

(* B' has at least the information of B. *)
Definition refines (B' B : rect) : Prop := forall z, inside z B' -> inside z B.

(* t clamped to [lo,hi], and the end of [lo,hi] that is farther from t. *)
Definition clamp (lo hi t : R) : R := Rmax lo (Rmin hi t).
Definition far_end (lo hi t : R) : R := if Rle_dec (hi - t) (t - lo) then lo else hi.

(* c clamped to the rectangle; the corner opposite to c's quadrant as seen from the centre. *)
Definition nearest (c : point) (B : rect) : point := (clamp (xlo B) (xhi B) (fst c), clamp (ylo B) (yhi B) (snd c)).
Definition farthest (c : point) (B : rect) : point :=
  (far_end (xlo B) (xhi B) (fst c), far_end (ylo B) (yhi B) (snd c)).

Definition ds (c : point) (B : rect) : R := dist c (nearest c B).
Definition dl (c : point) (B : rect) : R := dist c (farthest c B).

Lemma square_le u v : - v <= u <= v \/ v <= u <= - v -> u * u <= v * v.
Proof. intros [H | H]; nra. Qed.

Lemma clamp_spec lo hi t : lo <= hi -> lo <= clamp lo hi t <= hi /\
  forall z, lo <= z <= hi -> (t - clamp lo hi t) * (t - clamp lo hi t) <= (t - z) * (t - z).
Proof.
  intros H. unfold clamp, Rmax, Rmin.
  destruct (Rle_dec hi t); destruct (Rle_dec lo _); split; try lra; intros; apply square_le; lra.
Qed.

Lemma far_end_spec lo hi t : lo <= hi -> lo <= far_end lo hi t <= hi /\
  forall z, lo <= z <= hi -> (t - z) * (t - z) <= (t - far_end lo hi t) * (t - far_end lo hi t).
Proof.
  intros H. unfold far_end. destruct (Rle_dec (hi - t) (t - lo)); split; try lra; intros; apply square_le; lra.
Qed.

Lemma nearest_inside c B : inside (nearest c B) B.
Proof.
  destruct (clamp_spec (xlo B) (xhi B) (fst c) (x_ordered B)) as [X _].
  destruct (clamp_spec (ylo B) (yhi B) (snd c) (y_ordered B)) as [Y _].
  now split.
Qed.

Lemma farthest_inside c B : inside (farthest c B) B.
Proof.
  destruct (far_end_spec (xlo B) (xhi B) (fst c) (x_ordered B)) as [X _].
  destruct (far_end_spec (ylo B) (yhi B) (snd c) (y_ordered B)) as [Y _].
  now split.
Qed.

Lemma ds_le c B z : inside z B -> ds c B <= dist c z.
Proof.
  intros [Hx Hy]. apply dist_le. unfold dist2, nearest. simpl.
  destruct (clamp_spec (xlo B) (xhi B) (fst c) (x_ordered B)) as [_ X].
  destruct (clamp_spec (ylo B) (yhi B) (snd c) (y_ordered B)) as [_ Y].
  specialize (X _ Hx). specialize (Y _ Hy). lra.
Qed.

Lemma le_dl c B z : inside z B -> dist c z <= dl c B.
Proof.
  intros [Hx Hy]. apply dist_le. unfold dist2, farthest. simpl.
  destruct (far_end_spec (xlo B) (xhi B) (fst c) (x_ordered B)) as [_ X].
  destruct (far_end_spec (ylo B) (yhi B) (snd c) (y_ordered B)) as [_ Y].
  specialize (X _ Hx). specialize (Y _ Hy). lra.
Qed.

(* ds is the smallest distance, attained at the clamped point; dl the largest, attained at the opposite corner. *)
Theorem ds_attained c B : inside (nearest c B) B /\ dist c (nearest c B) = ds c B /\
  forall z, inside z B -> ds c B <= dist c z.
Proof. repeat split; try apply nearest_inside. apply ds_le. Qed.

Theorem dl_attained c B : inside (farthest c B) B /\ dist c (farthest c B) = dl c B /\
  forall z, inside z B -> dist c z <= dl c B.
Proof. repeat split; try apply farthest_inside. apply le_dl. Qed.

Lemma ds_nonneg c B : 0 <= ds c B.
Proof. apply dist_nonneg. Qed.

Lemma dl_nonneg c B : 0 <= dl c B.
Proof. apply dist_nonneg. Qed.

Theorem ds_le_dl c B : ds c B <= dl c B.
Proof. apply ds_le, farthest_inside. Qed.

(* Moving the point by d changes neither by more than d. *)
Theorem ds_lipschitz a b B : Rabs (ds a B - ds b B) <= dist a b.
Proof.
  assert (H : forall a b, ds a B <= dist a b + ds b B).
  { intros u v. pose proof (ds_le u B _ (nearest_inside v B)). pose proof (dist_triangle u v (nearest v B)).
    unfold ds in *. lra. }
  pose proof (H a b). pose proof (H b a). rewrite (dist_sym b a) in *. apply Rabs_le. lra.
Qed.

Theorem dl_lipschitz a b B : Rabs (dl a B - dl b B) <= dist a b.
Proof.
  assert (H : forall a b, dl a B <= dist a b + dl b B).
  { intros u v. pose proof (le_dl v B _ (farthest_inside u B)). pose proof (dist_triangle u v (farthest u B)).
    unfold dl in *. lra. }
  pose proof (H a b). pose proof (H b a). rewrite (dist_sym b a) in *. apply Rabs_le. lra.
Qed.

Lemma ds_move a b B : ds a B <= dist a b + ds b B.
Proof. pose proof (ds_lipschitz a b B). pose proof (Rle_abs (ds a B - ds b B)). lra. Qed.

Lemma dl_move a b B : dl a B <= dist a b + dl b B.
Proof. pose proof (dl_lipschitz a b B). pose proof (Rle_abs (dl a B - dl b B)). lra. Qed.

(* More information raises ds and lowers dl. *)
Theorem ds_monotone c B' B : refines B' B -> ds c B <= ds c B'.
Proof. intros H. apply ds_le, H, nearest_inside. Qed.

Theorem dl_monotone c B' B : refines B' B -> dl c B' <= dl c B.
Proof. intros H. apply le_dl, H, farthest_inside. Qed.

Lemma inside_convex t a b B : 0 <= t <= 1 -> inside a B -> inside b B -> inside (mix t a b) B.
Proof. intros T [A1 A2] [B1 B2]. unfold inside, mix. simpl. nra. Qed.

(* A circle about c of any radius between ds and dl meets the rectangle. *)
Theorem circle_meets_rect c B r : ds c B <= r <= dl c B -> exists z, inside z B /\ dist c z = r.
Proof.
  intros H. destruct (circle_meets_segment c r (nearest c B) (farthest c B) H) as [t [T E]].
  exists (mix t (nearest c B) (farthest c B)). split; [| exact E].
  apply inside_convex; [exact T | apply nearest_inside | apply farthest_inside].
Qed.

(* Going straight to the nearest point takes ds down as fast as one goes. *)
Lemma ds_towards t c B : 0 <= t <= 1 -> ds (mix t c (nearest c B)) B = (1 - t) * ds c B.
Proof.
  intros T. set (q := nearest c B). apply Rle_antisym.
  - change (ds c B) with (dist c q). rewrite <- (dist_mix_right t c q) by lra. apply ds_le, nearest_inside.
  - pose proof (ds_move c (mix t c q) B) as H. rewrite dist_mix_left in H by lra.
    replace (dist c q) with (ds c B) in H by reflexivity. lra.
Qed.

(* The corners at which a linear form is largest and least over a rectangle. *)
Definition highest (u : point) (B : rect) : point :=
  ((if Rle_dec 0 (fst u) then xhi B else xlo B), (if Rle_dec 0 (snd u) then yhi B else ylo B)).
Definition lowest (u : point) (B : rect) : point :=
  ((if Rle_dec 0 (fst u) then xlo B else xhi B), (if Rle_dec 0 (snd u) then ylo B else yhi B)).

Lemma highest_spec u B : inside (highest u B) B /\ forall z, inside z B -> dot u z <= dot u (highest u B).
Proof.
  pose proof (x_ordered B). pose proof (y_ordered B). unfold inside, highest, dot. simpl. split.
  - destruct (Rle_dec 0 (fst u)); destruct (Rle_dec 0 (snd u)); lra.
  - intros z [X Y]. destruct (Rle_dec 0 (fst u)); destruct (Rle_dec 0 (snd u)); nra.
Qed.

Lemma lowest_spec u B : inside (lowest u B) B /\ forall z, inside z B -> dot u (lowest u B) <= dot u z.
Proof.
  pose proof (x_ordered B). pose proof (y_ordered B). unfold inside, lowest, dot. simpl. split.
  - destruct (Rle_dec 0 (fst u)); destruct (Rle_dec 0 (snd u)); lra.
  - intros z [X Y]. destruct (Rle_dec 0 (fst u)); destruct (Rle_dec 0 (snd u)); nra.
Qed.

(* The axes exchanged. *)
Definition flip (B : rect) : rect := Rect (ylo B) (yhi B) (xlo B) (xhi B) (y_ordered B) (x_ordered B).
