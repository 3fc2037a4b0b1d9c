(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The Lebesgue outer measure of a rectangle, as Measure.v defines it, is its area: no countable cover has less. *)
From Coq Require Import Reals Lra Lia List.
From Dyadel Require Import Plane Distance Measure MeasureCut Compact.
Import ListNotations.
Open Scope R_scope.

(* ---- finite covers ---- *)

Lemma overlaps_le_step K : forall L, (forall Q, overlaps L Q <= area Q) -> areas L - areas K <= areas (cut_by L K).
Proof.
  induction K as [| Q K IH]; intros L H; simpl; [lra |]. pose proof (H Q) as HQ.
  assert (areas (cut_all L Q) - areas K <= areas (cut_by (cut_all L Q) K)).
  { apply IH. intros P. pose proof (cut_all_overlaps_le L Q P). pose proof (H P). lra. }
  rewrite cut_all_areas in *. lra.
Qed.

Lemma cut_by_within K : forall L P z, In P (cut_by L K) -> strictly z P ->
  (exists M, In M L /\ strictly z M) /\ forall Q, In Q K -> ~ inside z Q.
Proof.
  induction K as [| Q K IH]; intros L P z I S; simpl in I; [split; [now exists P | now intros Q []] |].
  destruct (IH _ P z I S) as [[M [J T]] N]. apply in_flat_map in J. destruct J as [O [J C]].
  destruct (cut_within O Q M z C T) as [U V]. split; [now exists O |].
  intros X [<- | Y]; [exact V | now apply N].
Qed.

Lemma areas_zero L : (forall Q, In Q L -> area Q = 0) -> areas L = 0.
Proof.
  induction L as [| Q L IH]; intros H; [reflexivity |]. simpl. rewrite (H Q), IH; [ring | | now left].
  intros P I. apply H. now right.
Qed.

Lemma finite_cover W K : covers K (fun z => inside z W) -> area W <= areas K.
Proof.
  intros C. pose proof (overlaps_le_step K [W]) as S. assert (Z : areas (cut_by [W] K) = 0).
  { apply areas_zero. intros P I. apply no_interior. intros z T.
    destruct (cut_by_within K [W] P z I T) as [[M [[<- | []] J]] N].
    destruct (C z (strictly_inside z W J)) as [Q [IQ D]]. exact (N Q IQ D). }
  rewrite Z in S. simpl in S. assert (area W + 0 - areas K <= 0); [| lra].
  apply S. intros Q. simpl. pose proof (overlap_le W Q). lra.
Qed.

(* ---- countable covers ---- *)

(* Q with a border of width |d|, and a width that adds at most e. *)
Lemma grown lo hi d : lo <= hi -> lo - Rabs d <= hi + Rabs d.
Proof. pose proof (Rabs_pos d). lra. Qed.
Definition grow (d : R) (Q : rect) : rect :=
  Rect (xlo Q - Rabs d) (xhi Q + Rabs d) (ylo Q - Rabs d) (yhi Q + Rabs d)
       (grown _ _ d (x_ordered Q)) (grown _ _ d (y_ordered Q)).
Definition border (Q : rect) (e : R) : R := e / (2 * (xhi Q - xlo Q + (yhi Q - ylo Q)) + 4 + e).

Lemma grow_little Q e : 0 < e -> 0 < border Q e /\ area (grow (border Q e) Q) <= area Q + e.
Proof.
  intros E. unfold border. set (s := xhi Q - xlo Q + (yhi Q - ylo Q)).
  assert (S : 0 <= s) by (pose proof (x_ordered Q); pose proof (y_ordered Q); unfold s; lra).
  set (d := e / (2 * s + 4 + e)). assert (P : 0 < d) by (apply Rdiv_lt_0_compat; lra).
  split; [exact P |].
  assert (M : d * (2 * s + 4 + e) = e) by (unfold d; field; lra).
  assert (d <= 1) by (apply (Rmult_le_reg_r (2 * s + 4 + e)); lra).
  assert (G : area (grow d Q) = area Q + d * (2 * s + 4 * d)).
  { unfold area, grow, s. simpl. rewrite Rabs_pos_eq by lra. ring. }
  rewrite G. assert (d * (2 * s + 4 * d) <= d * (2 * s + 4 + e)) by (apply Rmult_le_compat_l; lra). lra.
Qed.

Lemma sum_below_le f g n : (forall k, f k <= g k) -> sum_below f n <= sum_below g n.
Proof. intros H. induction n as [| n IH]; simpl; [lra |]. specialize (H n). lra. Qed.

Lemma sum_halves f e n : sum_below (fun k => f k + e / 2 ^ S k) n = sum_below f n + e - e / 2 ^ n.
Proof.
  induction n as [| n IH]; [simpl; field |]. cbn [sum_below]. rewrite IH.
  assert (2 ^ n <> 0) by (apply pow_nonzero; lra). simpl. field. assumption.
Qed.

Lemma areas_map G n : areas (map G (seq 0 n)) = sum_below (fun k => area (G k)) n.
Proof.
  induction n as [| n IH]; [reflexivity |]. rewrite seq_S, map_app, areas_app, IH. simpl. ring.
Qed.

Lemma open_cover W (Q : nat -> rect) (d : nat -> R) : (forall z, inside z W -> exists n, inside z (Q n)) ->
  (forall n, 0 < d n) -> exists n, covers (map (fun k => grow (d k) (Q k)) (seq 0 n)) (fun z => inside z W).
Proof.
  intros C D. set (G k := grow (d k) (Q k)).
  destruct (uniform_rect (fun z e => exists n, INR n <= / e /\ inside z (G n)) W) as [e [E F]].
  - intros z t e [T L] [n [N I]]. exists n. split; [| exact I].
    apply Rle_trans with (/ e); [exact N |]. apply Rinv_le_contravar; lra.
  - intros z Z. destruct (C z Z) as [n [X Y]]. specialize (D n).
    pose proof (pos_INR n) as N. set (i := / (INR n + 1)).
    assert (I : 0 < i) by (apply Rinv_0_lt_compat; lra).
    assert (M : 0 < Rmin (d n) i) by (apply Rmin_glb_lt; lra).
    pose proof (Rmin_l (d n) i). pose proof (Rmin_r (d n) i). exists (Rmin (d n) i). split; [exact M |].
    intros w Wx Wy. exists n. split.
    + apply Rle_trans with (/ i); [unfold i; rewrite Rinv_inv; lra | apply Rinv_le_contravar; lra].
    + unfold inside, G, grow. simpl. rewrite Rabs_pos_eq by lra. revert Wx Wy. unfold Rabs.
      destruct (Rcase_abs _); destruct (Rcase_abs _); lra.
  - destruct (archimed_cor1 e E) as [n [N N0]].
    assert (N' : / e < INR n).
    { apply lt_INR in N0. simpl in N0. rewrite <- (Rinv_inv (INR n)). apply Rinv_lt_contravar; [| exact N].
      apply Rmult_lt_0_compat; [apply Rinv_0_lt_compat; lra | exact E]. }
    exists n. intros z Z.
    destruct (F z Z z) as [k [K I]]; try (unfold Rminus; rewrite Rplus_opp_r, Rabs_R0; lra).
    exists (G k). split; [| exact I]. apply (in_map G), in_seq. split; [lia |]. apply INR_lt. simpl. lra.
Qed.

(* No upper bound is below the area, *)
Lemma rect_measure_least W m : measure_le (fun z => inside z W) m -> area W <= m.
Proof.
  intros H. apply le_epsilon. intros e E. destruct (H (e / 2)) as [Q [C Su]]; [lra |].
  set (t k := e / 2 / 2 ^ S k). assert (T : forall k, 0 < t k).
  { intros k. apply Rdiv_lt_0_compat; [lra |]. apply pow_lt. lra. }
  destruct (open_cover W Q (fun k => border (Q k) (t k)) C) as [n K]; [intros k; now apply grow_little |].
  apply finite_cover in K. rewrite areas_map in K. specialize (Su n).
  assert (L : sum_below (fun k => area (grow (border (Q k) (t k)) (Q k))) n
           <= sum_below (fun k => area (Q k) + e / 2 / 2 ^ S k) n).
  { apply sum_below_le. intros k. apply (proj2 (grow_little (Q k) (t k) (T k))). }
  rewrite sum_halves in L. assert (0 < e / 2 / 2 ^ n) by (apply Rdiv_lt_0_compat; [lra | apply pow_lt; lra]). lra.
Qed.

(* and the area is one. *)
Theorem rect_measure W m : measure_le (fun z => inside z W) m <-> area W <= m.
Proof.
  split; [apply rect_measure_least |]. intros M. apply (measure_subset _ (fun z => inside z W) (area W)); [tauto | exact M |].
  apply measure_of_content. intros e E. exists [W]. split; [intros z Z; exists W; split; [now left | exact Z] | simpl; lra].
Qed.
