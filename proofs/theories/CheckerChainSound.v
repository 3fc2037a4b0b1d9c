(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* A chain that holds: no centre on it is possibly nearest to one of its two sites. *)
From Coq Require Import Reals Lra Lia ZArith List Bool.
From Dyadel Require Import Plane Distance Cells Nerve Checker CheckerSound CheckerFaces CheckerComplete.
From Dyadel Require Import CheckerCover CheckerCoverSound CheckerChain.
Import ListNotations.
Open Scope R_scope.

(* z is a centre of the piece: a sum of its two ends by weights. *)
Definition on_piece (z : triple) (p : piece) : Prop :=
  in_triangle z (of_spot (from_spot p)) (of_spot (to_spot p)) (of_spot (to_spot p)).

Lemma exact_bounds S b A : is_box S b A -> 0 < S -> bounds S b A.
Proof.
  intros (X0 & X1 & Y0 & Y1) P x [X Y]. rewrite X0, X1, Y0, Y1. repeat split; rewrite (Rmult_comm S);
    apply Rmult_le_compat_r; lra.
Qed.

Theorem chain_avoids D E l edges B chains c a b q p z :
  check D E l edges = true -> describes l B -> In c chains -> ~ In c (broken_chains D E l chains) ->
  named l a (one c) -> named l b (other c) -> chain_pieces D E c = Some q -> In p q -> on_piece z p ->
  ~ allows (length l) (unit D E) B z a /\ ~ allows (length l) (unit D E) B z b.
Proof.
  intros C F I H A G Q P T. destruct (accepted_parts D E l edges C) as (bs & Sc & P0 & R0 & _).
  pose proof (unit_pos D E P0) as U. unfold broken_chains in H. rewrite Sc in H. cbv zeta in H.
  destruct (named_box D E l edges B C F bs Sc a _ A) as (ba & Ta & Fa & Na & Pa).
  destruct (named_box D E l edges B C F bs Sc b _ G) as (bb & Tb & Fb & Nb & Pb).
  match type of H with ~ In c (kept ?f chains) => destruct (f c) eqn:K; [destruct H; now apply in_kept |] end.
  clear H. cbv beta in K. rewrite Q in K.
  destruct (Map.find (one c) _) as [i |] eqn:Mi; [| discriminate]. destruct (Map.find (other c) _) as [j |] eqn:Mj; [| discriminate].
  apply (sought_box D E l edges C bs Sc) in Mi, Mj. assert (i = ba) by congruence. assert (j = bb) by congruence. subst i j.
  apply negb_false_iff, andb_true_iff in K. destruct K as [K _]. rewrite forallb_forall in K. specialize (K p P).
  unfold blocks in K. cbv zeta in K. destruct (Map.find (blocker_name p) _) as [k |] eqn:Mk; [| discriminate].
  apply (sought_box D E l edges C bs Sc) in Mk. rewrite !andb_true_iff, !Z.leb_le, !Z.ltb_lt in K.
  destruct K as [[[[[Wa Wb] Ai] Aj] Bi] Bj].
  destruct (found_named D E l edges B C F bs Sc _ _ Mk) as [_ Kn].
  destruct (found_box D E l edges B C F bs Sc _ _ Mk) as [Bk _].
  destruct (found_box D E l edges B C F bs Sc _ _ Fa) as [Ba _]. destruct (found_box D E l edges B C F bs Sc _ _ Fb) as [Bb _].
  rewrite Pa in Ba. rewrite Pb in Bb. apply exact_bounds in Bk, Ba, Bb; try exact U.
  split; intros Al; apply (Al _ Kn); unfold on_piece in T; (eapply beats_convex; [| | | exact T]); eapply spot_beats; eassumption.
Qed.
