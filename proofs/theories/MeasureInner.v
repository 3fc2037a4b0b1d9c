(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Inner content is at most outer measure, so both have the meaning intended. *)
From Coq Require Import Reals Lra Lia List.
From Dyadel Require Import Plane Distance Measure MeasureCut MeasureRect.
Import ListNotations.
Open Scope R_scope.

Lemma common_sym lo hi p q : lo <= hi -> p <= q -> common lo hi p q = common p q lo hi.
Proof. intros. clamps. Qed.

Lemma overlap_sym P Q : overlap P Q = overlap Q P.
Proof.
  unfold overlap. rewrite (common_sym (xlo P)) by apply x_ordered. now rewrite (common_sym (ylo P)) by apply y_ordered.
Qed.

Lemma cut_by_overlaps K : forall L, ForallOrdPairs apart K ->
  areas (cut_by L K) = areas L - fold_right (fun Q s => overlaps L Q + s) 0 K.
Proof.
  induction K as [| Q K IH]; intros L D; [simpl; ring |]. inversion D as [| ? ? F D']; subst. simpl.
  rewrite IH, cut_all_areas by exact D'.
  assert (E : fold_right (fun P s => overlaps (cut_all L Q) P + s) 0 K = fold_right (fun P s => overlaps L P + s) 0 K).
  { clear - F. induction F as [| P K A F IH]; [reflexivity |]. simpl. now rewrite IH, cut_all_overlaps. }
  rewrite E. ring.
Qed.

(* Rectangles that do not overlap have no more of Q than Q has. *)
Lemma packing K Q : ForallOrdPairs apart K -> overlaps K Q <= area Q.
Proof.
  intros D. pose proof (cut_by_overlaps K [Q] D) as E. pose proof (areas_nonneg (cut_by [Q] K)).
  assert (S : fold_right (fun P s => overlaps [Q] P + s) 0 K = overlaps K Q).
  { clear. induction K as [| P K IH]; [reflexivity |]. simpl in *. rewrite IH, (overlap_sym Q P). ring. }
  rewrite S in E. simpl in E. lra.
Qed.

Lemma finite_cover_list K L : ForallOrdPairs apart K -> (forall P, In P K -> covers L (fun z => inside z P)) ->
  areas K <= areas L.
Proof.
  intros D C. pose proof (overlaps_le_step L K (fun Q => packing K Q D)) as S.
  assert (Z : areas (cut_by K L) = 0).
  { apply areas_zero. intros P I. apply no_interior. intros z T.
    destruct (cut_by_within L K P z I T) as [[M [J T']] N].
    destruct (C M J z (strictly_inside z M T')) as [Q [IQ X]]. exact (N Q IQ X). }
  lra.
Qed.

(* The border of a rectangle, which has no area. *)
Definition edges (Q : rect) : list rect :=
  [Rect (xlo Q) (xlo Q) (ylo Q) (yhi Q) (Rle_refl _) (y_ordered Q); Rect (xhi Q) (xhi Q) (ylo Q) (yhi Q) (Rle_refl _) (y_ordered Q);
   Rect (xlo Q) (xhi Q) (ylo Q) (ylo Q) (x_ordered Q) (Rle_refl _); Rect (xlo Q) (xhi Q) (yhi Q) (yhi Q) (x_ordered Q) (Rle_refl _)].

Lemma edges_cover Q z : inside z Q -> strictly z Q \/ exists E, In E (edges Q) /\ inside z E.
Proof.
  intros [X Y].
  destruct (Req_dec (fst z) (xlo Q)) as [A | A]; [right; eexists; split; [now left | unfold inside; simpl; lra] |].
  destruct (Req_dec (fst z) (xhi Q)) as [B | B]; [right; eexists; split; [right; now left | unfold inside; simpl; lra] |].
  destruct (Req_dec (snd z) (ylo Q)) as [C | C]; [right; eexists; split; [right; right; now left | unfold inside; simpl; lra] |].
  destruct (Req_dec (snd z) (yhi Q)) as [D | D]; [right; eexists; split; [do 3 right; now left | unfold inside; simpl; lra] |].
  left. unfold strictly. lra.
Qed.

Lemma edges_area K : areas (flat_map edges K) = 0.
Proof.
  induction K as [| Q K IH]; [reflexivity |]. change (flat_map edges (Q :: K)) with (edges Q ++ flat_map edges K).
  rewrite areas_app, IH. unfold areas, edges, area. simpl. ring.
Qed.

(* A finite list, then a sequence. *)
Definition after (L : list rect) (Q : nat -> rect) (n : nat) : rect :=
  if (n <? length L)%nat then nth n L origin else Q (n - length L)%nat.

Lemma after_prefix L Q n : (n <= length L)%nat ->
  sum_below (fun k => area (after L Q k)) n = sum_below (fun k => area (nth k L origin)) n.
Proof.
  induction n as [| n IH]; intros N; [reflexivity |]. cbn [sum_below]. rewrite IH by lia. f_equal. f_equal.
  unfold after. assert (T : (n <? length L)%nat = true) by (apply Nat.ltb_lt; lia). now rewrite T.
Qed.

Lemma after_sum L Q m : (forall n, sum_below (fun k => area (Q k)) n <= m) -> forall n,
  sum_below (fun k => area (after L Q k)) n <= areas L + m.
Proof.
  intros H n. destruct (le_lt_dec n (length L)) as [N | N].
  - rewrite after_prefix by exact N. pose proof (sum_below_list L n). pose proof (H 0%nat). simpl in *. lra.
  - assert (E : forall j, sum_below (fun k => area (after L Q k)) (length L + j)
      = sum_below (fun k => area (nth k L origin)) (length L) + sum_below (fun k => area (Q k)) j).
    { clear. induction j as [| j IH].
      - rewrite Nat.add_0_r. simpl. rewrite Rplus_0_r. now apply after_prefix.
      - rewrite Nat.add_succ_r. cbn [sum_below]. rewrite IH. unfold after at 1.
        assert (T : (length L + j <? length L)%nat = false) by (apply Nat.ltb_ge; lia). rewrite T.
        replace (length L + j - length L)%nat with j by lia. ring. }
    replace n with (length L + (n - length L))%nat by lia. rewrite E.
    pose proof (sum_below_list L (length L)). pose proof (H (n - length L)%nat). lra.
Qed.

Lemma after_holds L (Q : nat -> rect) z : (exists P, In P L /\ inside z P) \/ (exists n, inside z (Q n)) ->
  exists n, inside z (after L Q n).
Proof.
  intros [[P [I D]] | [n D]].
  - destruct (In_nth _ _ origin I) as [n [N E]]. exists n. unfold after.
    assert (T : (n <? length L)%nat = true) by (now apply Nat.ltb_lt). rewrite T, E. exact D.
  - exists (length L + n)%nat. unfold after. assert (T : (length L + n <? length L)%nat = false) by (apply Nat.ltb_ge; lia).
    rewrite T. now replace (length L + n - length L)%nat with n by lia.
Qed.

Lemma covers_more (G : nat -> rect) m n A : (m <= n)%nat -> covers (map G (seq 0 m)) A -> covers (map G (seq 0 n)) A.
Proof.
  intros L C z Z. destruct (C z Z) as [P [I D]]. exists P. split; [| exact D]. apply in_map_iff in I.
  destruct I as [k [<- I]]. apply in_map. apply in_seq in I. apply in_seq. lia.
Qed.

Theorem inner_below_measure A m n : inner_ge A m -> measure_le A n -> m <= n.
Proof.
  intros HI HM. apply le_epsilon. intros e E.
  destruct (HI (e / 3)) as [K [WK [D S]]]; [lra |]. destruct (HM (e / 3)) as [Q [C T]]; [lra |].
  set (F := after (flat_map edges K) Q).
  assert (Cov : forall P, In P K -> forall z, inside z P -> exists k, inside z (F k)).
  { intros P IP z Z. apply after_holds. destruct (edges_cover P z Z) as [Y | [X [IX Y]]].
    - right. apply C. rewrite Forall_forall in WK. now apply (WK P).
    - left. exists X. split; [| exact Y]. apply in_flat_map. now exists P. }
  set (t k := e / 3 / 2 ^ Datatypes.S k). assert (Tp : forall k, 0 < t k).
  { intros k. apply Rdiv_lt_0_compat; [lra |]. apply pow_lt. lra. }
  set (G k := grow (border (F k) (t k)) (F k)).
  assert (N : exists N, forall P, In P K -> covers (map G (seq 0 N)) (fun z => inside z P)).
  { clear - Cov Tp. clearbody F. induction K as [| P K IH]; [now exists 0%nat |].
    destruct IH as [N1 H1]. { intros R IR. apply Cov. now right. }
    destruct (open_cover P F (fun k => border (F k) (t k))) as [N2 H2].
    - apply Cov. now left.
    - intros k. now apply grow_little.
    - exists (Nat.max N1 N2). intros R [<- | IR].
      + apply (covers_more G N2); [lia | exact H2].
      + apply (covers_more G N1); [lia | now apply H1]. }
  destruct N as [N H]. pose proof (finite_cover_list K _ D H) as L. rewrite areas_map in L.
  assert (L2 : sum_below (fun k => area (G k)) N <= sum_below (fun k => area (F k) + e / 3 / 2 ^ Datatypes.S k) N).
  { apply sum_below_le. intros k. apply (proj2 (grow_little (F k) (t k) (Tp k))). }
  rewrite sum_halves in L2. assert (0 < e / 3 / 2 ^ N) by (apply Rdiv_lt_0_compat; [lra | apply pow_lt; lra]).
  pose proof (after_sum (flat_map edges K) Q (n + e / 3) T N) as L3. rewrite edges_area in L3. fold F in L3. lra.
Qed.
