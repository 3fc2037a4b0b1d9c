(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The curve of centres at equal distance (smallest, or largest) from two separated rectangles is the graph of a
   continuous function. Coordinates: s along u, across which the rectangles are separated, and t along v. *)
From Coq Require Import Reals Lra Psatz Classical.
From Dyadel Require Import Plane Distance Orientation Disc.
Open Scope R_scope.

(* The distance that a letter speaks of, and the point where it is attained. *)
Definition reach (l : letter) (c : point) (B : rect) : R := match l with F => dl c B | C => ds c B end.
Definition touching (l : letter) (c : point) (B : rect) : point := match l with F => farthest c B | C => nearest c B end.

Lemma touches_reach l c r B : touches l c r B <-> reach l c B = r.
Proof. destruct l; reflexivity. Qed.

Lemma touching_inside l c B : inside (touching l c B) B.
Proof. destruct l; [apply farthest_inside | apply nearest_inside]. Qed.

Lemma touching_dist l c B : dist c (touching l c B) = reach l c B.
Proof. destruct l; reflexivity. Qed.

Lemma reach_nonneg l c B : 0 <= reach l c B.
Proof. destruct l; [apply dl_nonneg | apply ds_nonneg]. Qed.

Lemma reach_move l a b B : reach l a B <= dist a b + reach l b B.
Proof. destruct l; [apply dl_move | apply ds_move]. Qed.

(* Some point of the rectangle bounds the change of the squared distance from below, and one from above. *)
Lemma change_below l c c' B : exists a, inside a B /\
  dist2 c' a - dist2 c a <= reach l c' B * reach l c' B - reach l c B * reach l c B.
Proof.
  destruct l; simpl.
  - exists (farthest c B). split; [apply farthest_inside |]. unfold dl at 3 4. rewrite dist_sq.
    pose proof (le_dl c' B _ (farthest_inside c B)). pose proof (dist_nonneg c' (farthest c B)).
    rewrite <- (dist_sq c' (farthest c B)). nra.
  - exists (nearest c' B). split; [apply nearest_inside |]. unfold ds at 1 2. rewrite dist_sq.
    pose proof (ds_le c B _ (nearest_inside c' B)). pose proof (ds_nonneg c B).
    rewrite <- (dist_sq c (nearest c' B)). nra.
Qed.

Lemma change_above l c c' B : exists a, inside a B /\
  reach l c' B * reach l c' B - reach l c B * reach l c B <= dist2 c' a - dist2 c a.
Proof.
  destruct (change_below l c' c B) as [a [A H]]. exists a. split; [exact A | lra].
Qed.

Definition at_ (u v : point) (s t : R) : point := (s * fst u + t * fst v, s * snd u + t * snd v).

(* u, v are unit vectors at a right angle; sigma is the direction of the turn. *)
Definition frame (u v : point) (sigma : R) : Prop :=
  (forall p q, dist2 p q = (dot u p - dot u q) * (dot u p - dot u q) + (dot v p - dot v q) * (dot v p - dot v q)) /\
  (forall s t, dot u (at_ u v s t) = s /\ dot v (at_ u v s t) = t) /\
  sigma * sigma = 1 /\
  (forall a b c, (dot u b - dot u a) * (dot v c - dot v a) - (dot v b - dot v a) * (dot u c - dot u a) = sigma * orient a b c).

Section Curve.
Variables (u v : point) (sigma : R) (fr : frame u v sigma).
Variables (l : letter) (Y Z : rect) (gap : R).
Variable gap_pos : 0 < gap.
Variable separated : forall a b, inside a Y -> inside b Z -> dot u a + gap <= dot u b.

Let at' := at_ u v.

Lemma at_dist s t s' t' : dist (at' s t) (at' s' t') <= Rabs (s - s') + Rabs (t - t').
Proof.
  destruct fr as [D [A _]]. pose proof (Rabs_pos (s - s')). pose proof (Rabs_pos (t - t')).
  apply le_of_squares; [lra |]. rewrite dist_sq, D. unfold at'.
  destruct (A s t) as [-> ->]. destruct (A s' t') as [-> ->].
  pose proof (Rsqr_abs (s - s')) as P. pose proof (Rsqr_abs (t - t')) as Q. unfold Rsqr in P, Q. nra.
Qed.

(* Difference of the squared distances. *)
Definition excess (s t : R) : R :=
  reach l (at' s t) Y * reach l (at' s t) Y - reach l (at' s t) Z * reach l (at' s t) Z.

Lemma excess_grows s s' t : s <= s' -> 2 * gap * (s' - s) <= excess s' t - excess s t.
Proof.
  intros S. unfold excess. destruct fr as [D [A _]].
  destruct (change_below l (at' s t) (at' s' t) Y) as [a [Ia Ha]].
  destruct (change_above l (at' s t) (at' s' t) Z) as [b [Ib Hb]].
  rewrite !D in Ha, Hb. unfold at' in *. destruct (A s t) as [E1 E2]. destruct (A s' t) as [E3 E4].
  rewrite E1, E2, E3, E4 in Ha, Hb. pose proof (separated a b Ia Ib).
  assert (0 <= (s' - s) * (dot u b - dot u a - gap)) by (apply Rmult_le_pos; lra). nra.
Qed.

Lemma reach_continuous m B f g : continuity f -> continuity g -> continuity (fun x => reach m (at' (f x) (g x)) B).
Proof.
  intros Cf Cg x e E. destruct (Cf x (e / 2)) as [d [D Hd]]; [lra |]. destruct (Cg x (e / 2)) as [k [K Hk]]; [lra |].
  exists (Rmin d k). split; [now apply Rmin_pos |]. intros y [Ny Dy]. simpl in *. unfold R_dist in *.
  pose proof (Rmin_l d k). pose proof (Rmin_r d k).
  assert (Yd : Rabs (y - x) < d) by lra. assert (Yk : Rabs (y - x) < k) by lra.
  specialize (Hd y (conj Ny Yd)). specialize (Hk y (conj Ny Yk)).
  pose proof (at_dist (f y) (g y) (f x) (g x)) as W.
  pose proof (reach_move m (at' (f y) (g y)) (at' (f x) (g x)) B).
  pose proof (reach_move m (at' (f x) (g x)) (at' (f y) (g y)) B). rewrite (dist_sym (at' (f x) (g x))) in *.
  apply Rabs_def1; lra.
Qed.

Lemma excess_continuous f g : continuity f -> continuity g -> continuity (fun x => excess (f x) (g x)).
Proof.
  intros Cf Cg. unfold excess.
  apply (continuity_minus (fun x => reach l (at' (f x) (g x)) Y * reach l (at' (f x) (g x)) Y)
    (fun x => reach l (at' (f x) (g x)) Z * reach l (at' (f x) (g x)) Z)).
  - apply (continuity_mult (fun x => reach l (at' (f x) (g x)) Y) (fun x => reach l (at' (f x) (g x)) Y));
      now apply reach_continuous.
  - apply (continuity_mult (fun x => reach l (at' (f x) (g x)) Z) (fun x => reach l (at' (f x) (g x)) Z));
      now apply reach_continuous.
Qed.

Lemma id_continuous : continuity (fun x : R => x).
Proof. apply derivable_continuous, derivable_id. Qed.

Lemma const_continuous k : continuity (fun _ : R => k).
Proof. apply continuity_const. now intros ? ?. Qed.

Definition curve_root (t : R) : { s : R | excess s t = 0 }.
Proof.
  set (k := Rabs (excess 0 t) / (2 * gap)).
  assert (K : 0 <= k).
  { unfold k. apply Rmult_le_pos; [apply Rabs_pos |]. left. apply Rinv_0_lt_compat. lra. }
  assert (E : 2 * gap * k = Rabs (excess 0 t)) by (unfold k; field; lra).
  destruct (IVT_cor (fun s => excess s t) (- k) k) as [s [_ S]].
  - apply excess_continuous; [apply id_continuous | apply const_continuous].
  - lra.
  - pose proof (excess_grows (- k) 0 t ltac:(lra)). pose proof (excess_grows 0 k t K).
    pose proof (Rle_abs (excess 0 t)). pose proof (Rle_abs (- excess 0 t)) as N. rewrite Rabs_Ropp in N.
    assert (A : excess (- k) t <= 0) by lra. assert (B : 0 <= excess k t) by lra. nra.
  - exists s. exact S.
Defined.

Definition curve (t : R) : R := proj1_sig (curve_root t).

Lemma curve_zero t : excess (curve t) t = 0.
Proof. exact (proj2_sig (curve_root t)). Qed.

(* One centre on each line along u. *)
Theorem curve_unique s t : excess s t = 0 -> s = curve t.
Proof.
  intros H. pose proof (curve_zero t) as G. destruct (Rle_dec s (curve t)) as [L | L].
  - pose proof (excess_grows s (curve t) t L). nra.
  - pose proof (excess_grows (curve t) s t ltac:(lra)). nra.
Qed.

Theorem curve_continuous : continuity curve.
Proof.
  intros t e E.
  destruct (excess_continuous (fun _ => curve t) (fun x => x) (const_continuous _) id_continuous t (gap * e))
    as [d [D H]]; [nra |].
  exists d. split; [exact D |]. intros x [Nx Dx]. specialize (H x (conj Nx Dx)). simpl in *. unfold R_dist in *.
  rewrite (curve_zero t), Rminus_0_r in H. apply Rabs_def2 in H. pose proof (curve_zero x) as G.
  apply Rabs_def1.
  - apply Rnot_le_lt. intros C. pose proof (excess_grows (curve t) (curve x) x ltac:(lra)). nra.
  - apply Rnot_le_lt. intros C. pose proof (excess_grows (curve x) (curve t) x ltac:(lra)). nra.
Qed.

Lemma curve_equal t : reach l (at' (curve t) t) Y = reach l (at' (curve t) t) Z.
Proof.
  pose proof (curve_zero t) as H. unfold excess in H.
  apply Rsqr_inj; [apply reach_nonneg | apply reach_nonneg | unfold Rsqr; lra].
Qed.
End Curve.
