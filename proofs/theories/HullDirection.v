(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Vertices of the hull, by directions [HUL-1] [HUL-2]: who forbids a direction is decided at corners, the forbidden ones
   are convex cones, and steps round the circle of directions cover it. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Finite Distance Cells Nerve Orientation.
Open Scope R_scope.

(* Y is farther out than X in direction u, wherever their points are. *)
Definition beyond (u : point) (X Y : rect) : Prop := dot u (highest u X) < dot u (lowest u Y).

Theorem beyond_corners u X Y : beyond u X Y <-> forall x y, corner x X -> corner y Y -> dot u x < dot u y.
Proof.
  unfold beyond. assert (Hc : corner (highest u X) X).
  { unfold corner, highest. simpl. destruct (Rle_dec 0 (fst u)); destruct (Rle_dec 0 (snd u)); tauto. }
  assert (Lc : corner (lowest u Y) Y).
  { unfold corner, lowest. simpl. destruct (Rle_dec 0 (fst u)); destruct (Rle_dec 0 (snd u)); tauto. }
  split; intros H.
  - intros x y Cx Cy. pose proof (proj2 (highest_spec u X) x (corner_inside x X Cx)).
    pose proof (proj2 (lowest_spec u Y) y (corner_inside y Y Cy)). lra.
  - now apply H.
Qed.

Lemma beyond_points u X Y : beyond u X Y <-> forall x y, inside x X -> inside y Y -> dot u x < dot u y.
Proof.
  split; intros H.
  - intros x y Ix Iy. pose proof (proj2 (highest_spec u X) x Ix). pose proof (proj2 (lowest_spec u Y) y Iy).
    unfold beyond in H. lra.
  - apply H; [apply highest_spec | apply lowest_spec].
Qed.

(* These directions are an open convex cone, which never holds two that are opposite. *)
Theorem beyond_cone u v s t X Y : 0 <= s -> 0 <= t -> 0 < s + t -> beyond u X Y -> beyond v X Y ->
  beyond (s * fst u + t * fst v, s * snd u + t * snd v) X Y.
Proof.
  intros S T P U V. rewrite beyond_points in *. intros x y Ix Iy. specialize (U x y Ix Iy). specialize (V x y Ix Iy).
  assert (E : forall z, dot (s * fst u + t * fst v, s * snd u + t * snd v) z = s * dot u z + t * dot v z)
    by (intros; unfold dot; simpl; ring). rewrite !E.
  destruct (Rle_lt_or_eq_dec 0 s S) as [S1 | <-].
  - pose proof (Rmult_lt_compat_l s _ _ S1 U). assert (t * dot v x <= t * dot v y) by (apply Rmult_le_compat_l; lra). lra.
  - assert (T1 : 0 < t) by lra. pose proof (Rmult_lt_compat_l t _ _ T1 V). lra.
Qed.

Theorem beyond_not_opposite u X Y : beyond u X Y -> ~ beyond (- fst u, - snd u) X Y.
Proof.
  rewrite !beyond_points. intros H G. specialize (H _ _ (nearest_inside (0, 0) X) (nearest_inside (0, 0) Y)).
  specialize (G _ _ (nearest_inside (0, 0) X) (nearest_inside (0, 0) Y)). unfold dot in *. simpl in *. lra.
Qed.

Theorem meeting_never_beyond u X Y z : inside z X -> inside z Y -> ~ beyond u X Y.
Proof. intros A C. rewrite beyond_points. intros H. specialize (H z z A C). lra. Qed.

(* A possible vertex: a direction that no site forbids. *)
Theorem possible_vertex N B v : (v < N)%nat ->
  ((exists u, u <> (0, 0) /\ forall k, (k < N)%nat -> ~ beyond u (B v) (B k)) <->
   (exists p u m, choice N B p /\ u <> (0, 0) /\ dot u (p v) = m /\ forall k, (k < N)%nat -> dot u (p k) <= m)).
Proof.
  intros V. split.
  - intros [u [U H]]. assert (F : exists u, possible_far N B (fun k => k = v) u).
    { exists u. split; [exact U |]. intros i k _ -> K. specialize (H k K). unfold beyond in H. lra. }
    apply (nerve_far N B (fun k => k = v) (ex_intro _ v (conj V eq_refl))) in F.
    destruct F as [p [w [m [P [W [E L]]]]]]. exists p, w, m. split; [exact P |]. split; [exact W |]. split; [exact (E v V eq_refl) | exact L].
  - intros [p [u [m [P [U [E L]]]]]]. exists u. split; [exact U |]. intros k K H. rewrite beyond_points in H.
    specialize (H _ _ (P v V) (P k K)). pose proof (L k K). lra.
Qed.

(* A sure vertex: a direction in which all others are behind; then it is the only one farthest out, for every choice. *)
Theorem sure_vertex N B v u : (v < N)%nat -> (forall k, (k < N)%nat -> k <> v -> beyond u (B k) (B v)) ->
  forall p, choice N B p -> forall k, (k < N)%nat -> k <> v -> dot u (p k) < dot u (p v).
Proof.
  intros V H p P k K D. specialize (H k K D). rewrite beyond_points in H. exact (H _ _ (P k K) (P v V)).
Qed.

Definition cross (a b : point) : R := fst a * snd b - snd a * fst b.

(* A step of the walk: from u to v, less than half a turn counterclockwise. It passes the start if (1,0) is in (u,v]. *)
Definition passes (u v : point) : Prop := 0 < cross u (1, 0) /\ 0 <= cross (1, 0) v.
Definition in_step (u v w : point) : Prop := 0 <= cross u w /\ 0 < cross w v.

(* A direction in the step from u to v is forbidden by the site that forbids u and has v as the end of its cone. *)
Theorem step_forbidden u v w X Y : 0 < cross u v -> beyond u X Y ->
  (forall x y, inside x X -> inside y Y -> dot v x <= dot v y) -> in_step u v w -> beyond w X Y.
Proof.
  intros C U V [A D]. rewrite beyond_points in *. intros x y Ix Iy. specialize (U x y Ix Iy). specialize (V x y Ix Iy).
  assert (E : forall z, cross u v * dot w z = cross w v * dot u z + cross u w * dot v z)
    by (intros; unfold cross, dot; ring).
  apply (Rmult_lt_reg_l (cross u v)); [exact C |]. rewrite !E.
  pose proof (Rmult_lt_compat_l (cross w v) _ _ D U). pose proof (Rmult_le_compat_l (cross u w) _ _ A V). lra.
Qed.
