(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Combinations of points known to rectangles: image, ends, width [CMB-1]. One coordinate; both are the same. *)
From Coq Require Import Reals Lra Lia Psatz List ZArith.
From Flocq Require Import Core.
Import ListNotations.
Open Scope R_scope.

(* A term: its weight and its side [lo,hi]. *)
Record term : Type := Term { weight : R; lo : R; hi : R }.
Definition proper (t : term) : Prop := lo t <= hi t.
Definition low (t : term) : R := if Rle_dec 0 (weight t) then weight t * lo t else weight t * hi t.
Definition high (t : term) : R := if Rle_dec 0 (weight t) then weight t * hi t else weight t * lo t.
Definition total (f : term -> R) (l : list term) : R := fold_right (fun t s => f t + s) 0 l.

(* A choice: one number in each side. *)
Inductive chosen : list term -> list R -> Prop :=
| chosen_none : chosen [] []
| chosen_more t x l v : lo t <= x <= hi t -> chosen l v -> chosen (t :: l) (x :: v).
Fixpoint combine (l : list term) (v : list R) : R :=
  match l, v with t :: l, x :: v => weight t * x + combine l v | _, _ => 0 end.

Lemma term_between t x : lo t <= x <= hi t -> low t <= weight t * x <= high t.
Proof. intros X. unfold low, high. destruct (Rle_dec 0 (weight t)); nra. Qed.

(* Every choice gives a value between the ends, and both ends are values. *)
Theorem combination_encloses l v s : chosen l v -> total low l + s <= combine l v + s <= total high l + s.
Proof.
  intros C. assert (total low l <= combine l v <= total high l); [| lra].
  induction C as [| t x l v X _ IH]; simpl; [lra |]. pose proof (term_between t x X). lra.
Qed.

Theorem combination_ends_attained l : Forall proper l ->
  (exists v, chosen l v /\ combine l v = total low l) /\ (exists v, chosen l v /\ combine l v = total high l).
Proof.
  intros F. induction F as [| t l P _ [[v [Cv Ev]] [w [Cw Ew]]]].
  - split; exists []; (split; [constructor | reflexivity]).
  - unfold proper in P. split; simpl; [unfold low at 1 | unfold high at 1]; destruct (Rle_dec 0 (weight t)).
    + exists (lo t :: v). split; [constructor; [lra | exact Cv] | simpl; now rewrite Ev].
    + exists (hi t :: v). split; [constructor; [lra | exact Cv] | simpl; now rewrite Ev].
    + exists (hi t :: w). split; [constructor; [lra | exact Cw] | simpl; now rewrite Ew].
    + exists (lo t :: w). split; [constructor; [lra | exact Cw] | simpl; now rewrite Ew].
Qed.

(* Exact points give a point. *)
Theorem combination_exact l : Forall (fun t => lo t = hi t) l -> total low l = total high l.
Proof.
  intros F. induction F as [| t l E _ IH]; simpl; [reflexivity |]. rewrite IH. unfold low, high. rewrite E.
  now destruct (Rle_dec 0 (weight t)).
Qed.

(* Its width. *)
Theorem combination_width l : total high l - total low l = total (fun t => Rabs (weight t) * (hi t - lo t)) l.
Proof.
  induction l as [| t l IH]; simpl; [ring |].
  assert (E : high t - low t = Rabs (weight t) * (hi t - lo t)).
  { unfold high, low. destruct (Rle_dec 0 (weight t)); [rewrite Rabs_pos_eq by lra | rewrite Rabs_left by lra]; ring. }
  lra.
Qed.

Lemma width_small l d : Forall (fun t => hi t - lo t <= d) l ->
  total high l - total low l <= total (fun t => Rabs (weight t)) l * d.
Proof.
  intros F. rewrite combination_width. induction F as [| t l E _ IH]; simpl; [lra |].
  pose proof (Rabs_pos (weight t)). assert (Rabs (weight t) * (hi t - lo t) <= Rabs (weight t) * d)
    by (apply Rmult_le_compat_l; lra). lra.
Qed.

(* Rounded outward to multiples of u > 0 it encloses as well, and is less than 2 u wider. *)
Definition down (u x : R) : R := IZR (Zfloor (x / u)) * u.
Definition up (u x : R) : R := IZR (Zceil (x / u)) * u.

Lemma down_spec u x : 0 < u -> down u x <= x < down u x + u.
Proof.
  intros U. unfold down. pose proof (Zfloor_lb (x / u)) as L. pose proof (Zfloor_ub (x / u)) as G.
  apply (Rmult_le_compat_r u) in L; [| lra]. apply (Rmult_lt_compat_r u) in G; [| lra].
  replace (x / u * u) with x in * by (field; lra). lra.
Qed.

Lemma up_spec u x : 0 < u -> x <= up u x < x + u.
Proof.
  intros U. pose proof (down_spec u (- x) U) as D. unfold up, down, Zceil in *.
  replace (- (x / u)) with (- x / u) by (field; lra). rewrite opp_IZR. lra.
Qed.

(* So with parts as narrow as asked for, 2^-(bits + 1 + g) where 2^g is at least the sum of |weights|, the result is
   narrower than 2^-bits; it holds the value of every choice. *)
Theorem combination_narrow l s bits g : Forall (fun t => hi t - lo t <= bpow radix2 (- (bits + 1 + g))) l ->
  total (fun t => Rabs (weight t)) l <= bpow radix2 g -> let u := bpow radix2 (- bits - 2) in
  up u (total high l + s) - down u (total low l + s) < bpow radix2 (- bits) /\
  forall v, chosen l v -> down u (total low l + s) <= combine l v + s <= up u (total high l + s).
Proof.
  intros F W u. assert (U : 0 < u) by apply bpow_gt_0.
  pose proof (down_spec u (total low l + s) U). pose proof (up_spec u (total high l + s) U). split.
  - pose proof (width_small l _ F) as Q. set (b := bpow radix2 (- bits)).
    assert (Eu : u = b / 4).
    { unfold u, b. replace (- bits - 2)%Z with (- bits + -2)%Z by ring. rewrite bpow_plus. change (bpow radix2 (-2)) with (/ 4). field. }
    assert (Ed : bpow radix2 g * bpow radix2 (- (bits + 1 + g)) = b / 2).
    { rewrite <- bpow_plus. replace (g + - (bits + 1 + g))%Z with (- bits + -1)%Z by ring. rewrite bpow_plus.
      unfold b. change (bpow radix2 (-1)) with (/ 2). field. }
    assert (total (fun t => Rabs (weight t)) l * bpow radix2 (- (bits + 1 + g)) <= b / 2).
    { rewrite <- Ed. apply Rmult_le_compat_r; [apply bpow_ge_0 | exact W]. }
    lra.
  - intros v C. pose proof (combination_encloses l v s C). lra.
Qed.
