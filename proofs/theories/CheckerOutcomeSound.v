(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* What an outcome says, where the checker proves it: "decided", "certified" for a bound of area or Hausdorff distance.
   For "fixpoint" see CheckerStillSound.v. *)
From Coq Require Import Reals Lra Lia Psatz ZArith List Bool.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Bounds Measure Checker CheckerSound CheckerFaces.
From Dyadel Require Import CheckerComplete CheckerBounds CheckerBoundsSound CheckerTies.
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
