(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Sure vertices of the hull by intersecting arcs of directions [HUL-2]. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Finite Distance Cells Nerve Orientation HullDirection HullWalk.
Import ListNotations.
Open Scope R_scope.

Definition same_direction (a b : point) : Prop := cross a b = 0 /\ 0 < dot a b.
Definition start_in (lo hi from to : point) : Prop := in_arc from to lo \/ same_direction lo from.
Definition end_in (lo hi from to : point) : Prop := in_arc from to hi \/ same_direction hi to.

Lemma same_is_scaled a b : same_direction a b -> exists t, 0 < t /\ a = scale t b.
Proof.
  intros [C D]. destruct a as [a1 a2], b as [b1 b2]. unfold cross, dot, scale in *. simpl in *.
  assert (S : 0 < b1 * b1 + b2 * b2).
  { apply Rnot_le_lt. intros N. assert (b1 = 0) by nra. assert (b2 = 0) by nra. subst. lra. }
  exists ((a1 * b1 + a2 * b2) / (b1 * b1 + b2 * b2)). split; [now apply Rdiv_lt_0_compat |].
  assert (E1 : a1 * (b1 * b1 + b2 * b2) = (a1 * b1 + a2 * b2) * b1 + (a1 * b2 - a2 * b1) * b2) by ring.
  assert (E2 : a2 * (b1 * b1 + b2 * b2) = (a1 * b1 + a2 * b2) * b2 - (a1 * b2 - a2 * b1) * b1) by ring.
  rewrite C in E1, E2. f_equal; apply (Rmult_eq_reg_r (b1 * b1 + b2 * b2)); try lra.
  - rewrite E1. field. lra.
  - rewrite E2. field. lra.
Qed.

Lemma arc_nonneg a b : is_arc a b -> 0 <= cross a b.
Proof. intros [H | [H _]]; lra. Qed.

(* Two directions strictly between the ends of one arc, counterclockwise by at most a half turn, are by less than one. *)
Lemma inner_arc lo hi a b : in_arc lo hi a -> in_arc lo hi b -> is_arc a b -> 0 < cross a b.
Proof.
  intros [A _] [B _] [H | [E D]]; [exact H | exfalso].
  assert (I : cross lo b * dot a a = cross lo a * dot a b + cross a b * dot lo a) by (unfold cross, dot; ring).
  assert (0 <= dot a a) by (unfold dot; nra). rewrite E in I. nra.
Qed.

(* The arc that remains when both ends of the intersection are found: start and end as the code takes them. *)
Theorem narrow_exact lo hi from to (from_in to_in : bool) : is_arc lo hi -> is_arc from to ->
  (if from_in then in_arc lo hi from else start_in lo hi from to) ->
  (if to_in then in_arc lo hi to else end_in lo hi from to) ->
  let a := if from_in then from else lo in let b := if to_in then to else hi in
  is_arc a b /\ forall u, in_arc a b u <-> in_arc lo hi u /\ in_arc from to u.
Proof.
  intros P Q S T. pose proof (arc_nonneg _ _ P) as P0. pose proof (arc_nonneg _ _ Q) as Q0.
  (* u between a and b, seen from c: *)
  assert (L : forall a b c u, 0 < cross a b -> in_arc a b u -> 0 <= cross c a -> 0 <= cross c b -> 0 < cross c a + cross c b -> 0 < cross c u).
  { intros a b c u C [U1 U2] A D E. assert (F' : cross c u * cross a b = cross c a * cross u b + cross c b * cross a u) by (unfold cross in *; ring).
    pose proof (Rmult_le_pos _ _ A (Rlt_le _ _ U2)). pose proof (Rmult_le_pos _ _ D (Rlt_le _ _ U1)).
    assert (0 < cross c a \/ 0 < cross c b) as [G | G] by (destruct (Rle_lt_or_eq_dec _ _ A); [left | right]; lra).
    - pose proof (Rmult_lt_0_compat _ _ G U2). apply Rnot_le_lt. intros X. nra.
    - pose proof (Rmult_lt_0_compat _ _ G U1). apply Rnot_le_lt. intros X. nra. }
  assert (R : forall a b c u, 0 < cross a b -> in_arc a b u -> 0 <= cross a c -> 0 <= cross b c -> 0 < cross a c + cross b c -> 0 < cross u c).
  { intros a b c u C [U1 U2] A D E.
    assert (F' : cross u c * cross a b = cross a c * cross u b + cross b c * cross a u) by (unfold cross in *; ring).
    pose proof (Rmult_le_pos _ _ A (Rlt_le _ _ U2)). pose proof (Rmult_le_pos _ _ D (Rlt_le _ _ U1)).
    assert (0 < cross a c \/ 0 < cross b c) as [G | G] by (destruct (Rle_lt_or_eq_dec _ _ A); [left | right]; lra).
    - pose proof (Rmult_lt_0_compat _ _ G U2). apply Rnot_le_lt. intros X. nra.
    - pose proof (Rmult_lt_0_compat _ _ G U1). apply Rnot_le_lt. intros X. nra. }
  destruct from_in, to_in; simpl.
  - (* the new arc is inside *)
    pose proof (inner_arc _ _ _ _ S T Q) as C. split; [now left |]. intros u. split; [| tauto]. intros U. split; [| exact U].
    destruct S as [S1 S2], T as [T1 T2]. split; [apply (L from to) | apply (R from to)]; try assumption; lra.
  - destruct S as [S1 S2]. split; [now left |]. intros u. split; [| intros [[? ?] [? ?]]; now split].
    intros U. pose proof U as [U1 U2]. split; [split; [| exact U2] | split; [exact U1 |]].
    + apply (L from hi); try assumption; lra.
    + destruct T as [[T1 T2] | T]; [apply (R from hi); try assumption; lra |].
      destruct (same_is_scaled _ _ T) as [t [Ht ->]]. rewrite cross_scale_r in U2. nra.
  - destruct T as [T1 T2]. split; [now left |]. intros u. split; [| intros [[? ?] [? ?]]; now split].
    intros U. pose proof U as [U1 U2]. split; [split; [exact U1 |] | split; [| exact U2]].
    + apply (R lo to); try assumption; lra.
    + destruct S as [[S1 S2] | S]; [apply (L lo to); try assumption; lra |].
      destruct (same_is_scaled _ _ S) as [t [Ht ->]]. rewrite cross_scale_l in U1. nra.
  - split; [exact P |]. intros u. split; [| tauto]. intros U. split; [exact U |]. pose proof U as [U1 U2].
    destruct S as [S | S], T as [T | T].
    + pose proof (inner_arc _ _ _ _ S T P) as C. destruct S as [S1 S2], T as [T1 T2].
      split; [apply (L lo hi) | apply (R lo hi)]; try assumption; lra.
    + destruct (same_is_scaled _ _ T) as [t [Ht ->]]. destruct S as [S1 S2]. rewrite cross_scale_r in U2.
      assert (D : 0 < cross u to) by nra. split; [| exact D]. apply (L lo to); try assumption; [now split | lra | lra].
    + destruct (same_is_scaled _ _ S) as [t [Ht ->]]. destruct T as [T1 T2]. rewrite cross_scale_l in U1.
      assert (D : 0 < cross from u) by nra. split; [exact D |]. apply (R from hi); try assumption; [now split | lra | lra].
    + destruct (same_is_scaled _ _ S) as [s [Hs ->]], (same_is_scaled _ _ T) as [t [Ht ->]].
      rewrite cross_scale_l in U1. rewrite cross_scale_r in U2. split; nra.
Qed.

(* If the arcs have a direction in common, the code finds both ends. *)
Theorem narrow_finds lo hi from to u : is_arc lo hi -> is_arc from to -> in_arc lo hi u -> in_arc from to u ->
  (in_arc lo hi from \/ start_in lo hi from to) /\ (in_arc lo hi to \/ end_in lo hi from to).
Proof.
  intros P Q [U1 U2] [W1 W2]. pose proof (arc_nonneg _ _ P) as P0. pose proof (arc_nonneg _ _ Q) as Q0.
  assert (S : forall a b, cross a b = 0 -> (0 < cross a u /\ 0 < cross b u) \/ (0 < cross u a /\ 0 < cross u b) -> same_direction a b).
  { intros a b E H. split; [exact E |].
    assert (I : dot a b * dot u u = dot a u * dot b u + cross a u * cross b u) by (unfold dot, cross; ring).
    assert (J : dot a u * cross b u = dot b u * cross a u - cross a b * dot u u) by (unfold dot, cross; ring).
    rewrite E in J. rewrite (cross_swap u a), (cross_swap u b) in H. assert (0 <= dot u u) by (unfold dot; nra).
    assert (0 < cross a u * cross b u) by (destruct H as [[? ?] | [? ?]]; nra).
    assert (0 <= dot a u * dot b u * (cross a u * cross b u)).
    { replace (dot a u * dot b u * (cross a u * cross b u)) with ((dot a u * cross b u) * (dot b u * cross a u)) by ring.
      rewrite J. apply Rle_trans with ((dot b u * cross a u) * (dot b u * cross a u)); [apply Rle_0_sqr | right; ring]. }
    assert (0 <= dot a u * dot b u) by (apply Rnot_lt_le; intros X; nra).
    apply Rnot_le_lt. intros X. assert (dot a b * dot u u <= 0) by nra. lra. }
  assert (F : forall x y z, 0 < cross x u -> 0 < cross y u -> 0 < cross u z -> 0 <= cross x z -> 0 < cross x y -> 0 < cross y z).
  { intros x y z X Y Z G C. assert (E : cross y z * cross x u = cross x y * cross u z + cross x z * cross y u) by (unfold cross; ring).
    pose proof (Rmult_lt_0_compat _ _ C Z). pose proof (Rmult_le_pos _ _ G (Rlt_le _ _ Y)). apply Rnot_le_lt. intros L. nra. }
  assert (G : forall x y z, 0 < cross x u -> 0 < cross u y -> 0 < cross u z -> 0 <= cross x z -> 0 < cross y z -> 0 < cross x y).
  { intros x y z X Y Z H C. assert (E : cross x y * cross u z = cross y z * cross x u + cross x z * cross u y) by (unfold cross; ring).
    pose proof (Rmult_lt_0_compat _ _ C X). pose proof (Rmult_le_pos _ _ H (Rlt_le _ _ Y)). apply Rnot_le_lt. intros L. nra. }
  split.
  - destruct (Rtotal_order (cross lo from) 0) as [L | [E | L]].
    + right. left. rewrite cross_swap in L. assert (0 < cross from lo) by lra. split; [assumption |]. now apply (F from lo to).
    + right. right. apply S; [exact E | left; now split].
    + left. split; [exact L |]. now apply (F lo from hi).
  - destruct (Rtotal_order (cross hi to) 0) as [L | [E | L]].
    + left. assert (C : 0 < cross to hi) by (rewrite cross_swap; lra). split; [| exact C]. now apply (G lo to hi).
    + right. right. apply S; [exact E | right; now split].
    + right. left. split; [| exact L]. now apply (G from hi to).
Qed.

(* The direction that is asked next is in the arc: between its ends, or a quarter turn from the first. *)
Theorem next_in_arc a b s t : is_arc a b -> 0 < s -> 0 < t ->
  (cross a b <> 0 -> in_arc a b (s * fst a + t * fst b, s * snd a + t * snd b)) /\ (cross a b = 0 -> in_arc a b (turned a)).
Proof.
  intros P S T. split; intros H.
  - destruct P as [P | [P _]]; [| contradiction].
    assert (E1 : cross a (s * fst a + t * fst b, s * snd a + t * snd b) = t * cross a b) by (unfold cross; simpl; ring).
    assert (E2 : cross (s * fst a + t * fst b, s * snd a + t * snd b) b = s * cross a b) by (unfold cross; simpl; ring).
    unfold in_arc. rewrite E1, E2. split; now apply Rmult_lt_0_compat.
  - destruct P as [P | [_ D]]; [lra |].
    assert (E : cross (turned a) b = - dot a b) by (unfold cross, turned, dot; simpl; ring).
    unfold in_arc. rewrite E, cross_turned. split; [| lra].
    apply Rnot_le_lt. intros L. destruct a as [a1 a2]. unfold dot in *. simpl in *.
    assert (a1 = 0) by nra. assert (a2 = 0) by nra. subst. lra.
Qed.

Section Loop.
Variables (N : nat) (B : sites) (v : nat).
Let good (k : nat) (u : point) : Prop := beyond u (B k) (B v).
Let from (k : nat) : point := arc_from (B k) (B v).
Let to (k : nat) : point := arc_to (B k) (B v).

(* The loop: who violates the direction asked, which is in the arc so far; the ends as narrow_exact takes them. *)
Inductive loop : list nat -> point -> point -> Prop :=
| loop_first k : (k < N)%nat -> k <> v -> ~ no_arc (B k) (B v) -> loop [k] (from k) (to k)
| loop_more l lo hi k u (from_in to_in : bool) : loop l lo hi -> (k < N)%nat -> k <> v -> in_arc lo hi u -> ~ good k u ->
    ~ no_arc (B k) (B v) ->
    (if from_in then in_arc lo hi (from k) else start_in lo hi (from k) (to k)) ->
    (if to_in then in_arc lo hi (to k) else end_in lo hi (from k) (to k)) ->
    loop (k :: l) (if from_in then from k else lo) (if to_in then to k else hi).

Lemma arc_of k : ~ no_arc (B k) (B v) -> is_arc (from k) (to k) /\ forall u, in_arc (from k) (to k) u <-> good k u.
Proof. intros H. apply arc_is_beyond. apply NNPP. intros X. apply H. now apply no_arc_exact. Qed.

(* The arc holds just the directions good for all found so far; no site is found twice. *)
Theorem loop_holds l lo hi : loop l lo hi ->
  is_arc lo hi /\ (forall u, in_arc lo hi u <-> forall k, In k l -> good k u) /\ NoDup l /\ (length l <= N)%nat.
Proof.
  intros H. assert (G : is_arc lo hi /\ (forall u, in_arc lo hi u <-> forall k, In k l -> good k u) /\ NoDup l /\
    forall k, In k l -> (k < N)%nat).
  { induction H as [k K V A | l lo hi k u fi ti L IH K V U W A F T].
    - destruct (arc_of k A) as [Q E]. split; [exact Q |]. split; [| split].
      + intros u. rewrite E. split; [intros G m [<- | []]; exact G | intros G; apply G; now left].
      + constructor; [intros [] | constructor].
      + intros m [<- | []]. exact K.
    - destruct IH as [P [E [D I]]]. destruct (arc_of k A) as [Q Ek].
      destruct (narrow_exact lo hi (from k) (to k) fi ti P Q F T) as [R Er]. split; [exact R |]. split; [| split].
      + intros w. rewrite Er, E, Ek. split.
        * intros [X Y] m [<- | M]; [exact Y | now apply X].
        * intros X. split; [intros m M; apply X; now right | apply X; now left].
      + constructor; [| exact D]. intros M. apply W. exact (proj1 (E u) U k M).
      + intros m [<- | M]; [exact K | now apply I]. }
  destruct G as [P [E [D I]]]. split; [exact P |]. split; [exact E |]. split; [exact D |].
  rewrite <- (seq_length N 0). apply NoDup_incl_length; [exact D |]. intros k M. apply in_seq. specialize (I k M). lia.
Qed.

Definition sure_direction (u : point) : Prop := forall k, (k < N)%nat -> k <> v -> good k u.

(* Where it ends without a direction there is none: a site has no arc, or an end is not found. *)
Theorem loop_fails k : (k < N)%nat -> k <> v ->
  (no_arc (B k) (B v) -> ~ exists u, sure_direction u) /\
  (forall l lo hi, loop l lo hi ->
    ~ ((in_arc lo hi (from k) \/ start_in lo hi (from k) (to k)) /\ (in_arc lo hi (to k) \/ end_in lo hi (from k) (to k))) ->
    ~ exists u, sure_direction u).
Proof.
  intros K V. split.
  - intros A [u U]. apply no_arc_exact in A. apply A. exists u. now apply U.
  - intros l lo hi L F [u U]. apply F. destruct (loop_holds l lo hi L) as [P [E _]].
    assert (A : ~ no_arc (B k) (B v)) by (intros A; apply no_arc_exact in A; apply A; exists u; now apply U).
    destruct (arc_of k A) as [Q Ek]. apply (narrow_finds lo hi (from k) (to k) u P Q).
    + apply E. intros m M.
      assert (I : (m < N)%nat /\ m <> v); [| now apply U].
      clear - L M. induction L as [j J Vj _ | l lo hi j w fi ti L IH J Vj _ _ _ _ _]; destruct M as [<- | M]; try tauto; try now split.
    + apply Ek. now apply U.
Qed.
End Loop.
