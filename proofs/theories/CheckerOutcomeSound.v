(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* What an outcome says, where the checker proves it: "decided", "certified" for a bound of area or Hausdorff distance,
   "fixpoint". *)
From Coq Require Import Reals Lra Lia Psatz ZArith List Bool.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Bounds Measure Checker CheckerSound CheckerFaces.
From Dyadel Require Import CheckerComplete CheckerBounds CheckerBoundsSound CheckerCover CheckerCoverSound CheckerTies
  CheckerTiesSound.
Import ListNotations.
Open Scope R_scope.

Lemma legal_possible N B i j : (i < N)%nat -> (j < N)%nat -> legal N B i j -> possible N B i j.
Proof.
  intros I J L. apply possible_exact; try assumption. exists (fun k => nearest (0, 0) (B k)). split; [apply choice_nearest |].
  apply strict_is_weak; try assumption. apply (legal_sound N B i j _ I J L), choice_nearest.
Qed.

Lemma legal_sym N B i j : legal N B i j -> legal N B j i.
Proof. intros [c W]. exists c. now apply witness_sym. Qed.

Lemma listed_legal D E l edges B e a b : check D E l edges = true -> describes l B -> In e edges ->
  ((named l a (from e) /\ named l b (to e)) \/ (named l b (from e) /\ named l a (to e))) -> legal (length l) B a b.
Proof.
  intros C F I [[A G] | [A G]].
  - eexists. now apply (accepted_witness D E l edges B C F e a b).
  - apply legal_sym. eexists. now apply (accepted_witness D E l edges B C F e b a).
Qed.

Lemma named_below l a i : named l a i -> (a < length l)%nat.
Proof. intros [s [S _]]. apply nth_error_Some. congruence. Qed.

(* ---- decided: no pair is open ---- *)

Theorem outcome_decided D E l edges B a b i j : check D E l edges = true -> describes l B -> lists_all l B edges ->
  named l a i -> named l b j -> a <> b ->
  (possible (length l) B a b <-> legal (length l) B a b) /\
  (possible (length l) B a b <-> exists e, In e edges /\ ((from e = i /\ to e = j) \/ (from e = j /\ to e = i))).
Proof.
  intros C F All A G M. pose proof (named_below _ _ _ A) as Ka. pose proof (named_below _ _ _ G) as Kb.
  assert (Back : (exists e, In e edges /\ ((from e = i /\ to e = j) \/ (from e = j /\ to e = i))) -> legal (length l) B a b).
  { intros (e & I & Q). apply (listed_legal D E l edges B e a b C F I). destruct Q as [[<- <-] | [<- <-]]; tauto. }
  split; (split; [| try (intros H; now apply legal_possible)]); intros H.
  - apply Back. exact (All a b i j A G M H).
  - exact (All a b i j A G M H).
  - apply legal_possible; [exact Ka | exact Kb | now apply Back].
Qed.

(* ---- certified: the bound is as small as the goal asks ---- *)

Theorem reaches_value m n : bound_reaches m n = true -> value n <= powerRZ 2 (- m).
Proof.
  unfold bound_reaches. cbv zeta. rewrite andb_true_iff, orb_true_iff, andb_true_iff, Z.eqb_eq, !Z.leb_le, Z.eqb_eq. intros [D H].
  assert (T : forall e, 0 < powerRZ 2 e) by (intros; apply powerRZ_lt; lra).
  unfold value. rewrite D. unfold Rdiv. rewrite Rinv_1, Rmult_1_r.
  destruct H as [H | [K H]].
  - apply IZR_le in H. pose proof (T (expo n)). pose proof (T (- m)%Z). nra.
  - set (k := (- (expo n + m))%Z) in *. set (s := Z.min k enough) in *. assert (S0 : (0 <= s)%Z) by (unfold s, enough; lia).
    rewrite Z.shiftr_div_pow2 in H by exact S0. pose proof (Z.pow_pos_nonneg 2 s eq_refl S0) as P.
    apply Z.div_small_iff in H; [| lia].
    assert (L : (man n <= 2 ^ k)%Z).
    { assert (2 ^ s <= 2 ^ k)%Z by (apply Z.pow_le_mono_r; unfold s; lia). lia. }
    apply IZR_le in L. rewrite <- (Z2Nat.id k K), <- pow_IZR, pow_powerRZ, (Z2Nat.id k K) in L.
    replace (powerRZ 2 (- m)) with (powerRZ 2 k * powerRZ 2 (expo n)).
    + apply Rmult_le_compat_r; [left; apply T | exact L].
    + rewrite <- powerRZ_add by lra. f_equal. unfold k. ring.
Qed.

Theorem outcome_area D E l edges opened B bound m :
  check D E l edges = true -> describes l B -> lists_all l B (rev_append opened edges) ->
  area_holds D E l (rev_append opened edges) bound = true -> bound_reaches m bound = true ->
  exists v, v <= powerRZ 2 (- m) /\ measure_le (possible_region (length l) B) v.
Proof.
  intros C F G H R0. exists (value bound). split; [now apply reaches_value |].
  exact (accepted_area D E l edges opened B bound C F G H).
Qed.

Theorem outcome_hausdorff D E l edges opened B bound m p z :
  check D E l edges = true -> describes l B -> lists_all l B (rev_append opened edges) ->
  hausdorff_holds D E l edges opened bound = true -> bound_reaches m bound = true -> choice (length l) B p ->
  possible_region (length l) B z -> exists w, graph (length l) p w /\ dist z w <= powerRZ 2 (- m).
Proof.
  intros C F G H R0 P Z0. destruct (accepted_hausdorff D E l edges opened B bound p C F G H P) as [_ T].
  destruct (T z Z0) as [w [W L]]. exists w. split; [exact W |]. pose proof (reaches_value m bound R0). lra.
Qed.

(* ---- fixpoint: narrower rectangles change nothing ---- *)

Lemma same_rect (A A' : rect) : xlo A = xhi A -> ylo A = yhi A -> refines A' A -> refines A A'.
Proof.
  intros X Y Q z [Zx Zy]. destruct (Q (nearest z A') (nearest_inside z A')) as [Nx Ny].
  replace z with (nearest z A'); [apply nearest_inside |].
  destruct z as [u v]. destruct (nearest (u, v) A') as [u' v']. simpl in *. f_equal; lra.
Qed.

(* Of points there is nothing narrower, so that no bound changes either. *)
Theorem points_stay D E l edges B B' : check D E l edges = true -> describes l B -> all_points D E l = true ->
  refined (length l) B' B -> refined (length l) B B'.
Proof.
  intros C F H Q k K. destruct (accepted_parts D E l edges C) as (bs & Sc & P0 & _ & _). pose proof (unit_pos D E P0) as U.
  unfold all_points in H. rewrite Sc, forallb_forall in H.
  destruct (box_of D E l B F k K bs Sc P0) as (s & b & _ & T & _ & (X0 & X1 & Y0 & Y1) & _).
  specialize (H b (nth_error_In _ _ T)). unfold is_point in H. rewrite andb_true_iff, !Z.eqb_eq in H. destruct H as [Hx Hy].
  rewrite <- Hx in X1. rewrite <- Hy in Y1. apply same_rect; [| | exact (Q k K)]; apply (Rmult_eq_reg_r (unit D E)); lra.
Qed.

Theorem outcome_fixpoint D E l edges opened B B' complete hint a b i j :
  check D E l edges = true -> describes l B -> (complete = true -> lists_all l B (rev_append opened edges)) ->
  is_fixpoint D E l complete hint opened = true -> refined (length l) B' B ->
  named l a i -> named l b j -> a <> b ->
  (possible (length l) B' a b <-> possible (length l) B a b) /\ (legal (length l) B' a b <-> legal (length l) B a b).
Proof.
  intros C F All H Q A G M. pose proof (named_below _ _ _ A) as Ka. pose proof (named_below _ _ _ G) as Kb.
  assert (Down : possible (length l) B' a b -> possible (length l) B a b) by now apply possible_monotone.
  assert (Up : legal (length l) B a b -> legal (length l) B' a b).
  { intros [c W]. exists c. now apply (witness_monotone _ B' B). }
  unfold is_fixpoint in H. apply orb_true_iff in H. destruct H as [H | H].
  - pose proof (points_stay D E l edges B B' C F H Q) as R0. split; (split; [assumption || idtac | assumption || idtac]).
    + now apply possible_monotone.
    + intros [c W]. exists c. now apply (witness_monotone _ B B').
  - apply andb_true_iff in H. destruct H as [Cp T]. specialize (All Cp).
    assert (Tied : forall e, In e opened -> ~ In e (loose_ties D E l hint opened)).
    { intros e I. destruct (loose_ties D E l hint opened); [intros [] | discriminate]. }
    assert (Cases : possible (length l) B a b -> legal (length l) B a b \/
      (possible (length l) B' a b /\ forall B0, refined (length l) B0 B -> ~ legal (length l) B0 a b)).
    { intros P. destruct (All a b i j A G M P) as (e & I & N). rewrite rev_append_rev in I. apply in_app_iff in I.
      destruct I as [I | I].
      - apply in_rev in I. right. destruct N as [[<- <-] | [<- <-]].
        + split; [exact (proj1 (tie_stays D E l edges B B' hint opened e a b C F I (Tied e I) A G Q)) |].
          intros B0 Q0. exact (proj2 (tie_stays D E l edges B B0 hint opened e a b C F I (Tied e I) A G Q0)).
        + split; [apply possible_sym; exact (proj1 (tie_stays D E l edges B B' hint opened e b a C F I (Tied e I) G A Q)) |].
          intros B0 Q0 L. apply legal_sym in L.
          exact (proj2 (tie_stays D E l edges B B0 hint opened e b a C F I (Tied e I) G A Q0) L).
      - left. apply (listed_legal D E l edges B e a b C F I). destruct N as [[<- <-] | [<- <-]]; tauto. }
    split; (split; [try exact Down | try exact Up]).
    + intros P. destruct (Cases P) as [L | [P' _]]; [apply legal_possible; auto | exact P'].
    + intros L. destruct (Cases (Down (legal_possible _ _ _ _ Ka Kb L))) as [L' | [_ N]]; [exact L' | destruct (N B' Q L)].
Qed.
