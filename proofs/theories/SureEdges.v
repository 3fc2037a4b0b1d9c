(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Sure edges of the hull [HST-2]. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Nerve Orientation.
Open Scope R_scope.

(* The pair is a possible edge of the hull: some choice has all points on one closed side of a line through both. *)
Definition possible_edge (N : nat) (B : sites) (i j : nat) : Prop :=
  exists p u m, choice N B p /\ empty_half_plane N p (pair i j) u m.
Definition surely_oriented (A B C : rect) : Prop := surely_left A B C \/ surely_right A B C.

Lemma surely_oriented_nonzero A B C a b c : surely_oriented A B C -> inside a A -> inside b B -> inside c C ->
  orient a b c <> 0.
Proof. intros [H | H] Ia Ib Ic; specialize (H a b c Ia Ib Ic); lra. Qed.

(* All on the left of the line from a to b: a half-plane. *)
Lemma left_half_plane N p (S : nat -> Prop) a b : a <> b -> (forall k, (k < N)%nat -> 0 <= orient a b (p k)) ->
  (forall k, (k < N)%nat -> S k -> orient a b (p k) = 0) -> exists u m, empty_half_plane N p S u m.
Proof.
  intros D L Z. set (u := (snd b - snd a, - (fst b - fst a))). exists u, (dot u a).
  assert (E : forall z, dot u z = dot u a - orient a b z) by (intros; unfold u, dot, orient; simpl; ring).
  split; [| split].
  - intros H. apply D. unfold u in H. injection H as H1 H2. destruct a, b. simpl in *. f_equal; lra.
  - intros k K Sk. rewrite E, (Z k K Sk). ring.
  - intros k K. rewrite E. pose proof (L k K). lra.
Qed.

(* The first time at which one of finitely many continuous functions, positive at first, is not. *)
Lemma first_zero (f : nat -> R -> R) (P : nat -> Prop) N : (forall k, continuity (f k)) ->
  (forall k, (k < N)%nat -> P k -> 0 < f k 0) ->
  (exists k, (k < N)%nat /\ P k /\ f k 1 <= 0) ->
  exists s k, 0 <= s <= 1 /\ (k < N)%nat /\ P k /\ f k s = 0 /\ forall l, (l < N)%nat -> P l -> 0 <= f l s.
Proof.
  intros C Start [k0 [K0 [P0 Z0]]].
  set (ok t := 0 <= t <= 1 /\ forall l, (l < N)%nat -> P l -> forall r, 0 <= r <= t -> 0 < f l r).
  destruct (completeness ok) as [s [Ub Lub]].
  - exists 1. intros t [[_ T] _]. exact T.
  - exists 0. split; [lra |]. intros l L Pl r R. replace r with 0 by lra. now apply Start.
  - assert (S0 : 0 <= s).
    { apply Ub. split; [lra |]. intros l L Pl r R. replace r with 0 by lra. now apply Start. }
    assert (S1 : s <= 1) by (apply Lub; intros t [[_ T] _]; exact T).
    assert (Before : forall l r, (l < N)%nat -> P l -> 0 <= r < s -> 0 < f l r).
    { intros l r L Pl [R0 R1]. apply NNPP. intros H. assert (s <= r); [| lra]. apply Lub. intros t [T G].
      apply Rnot_lt_le. intros Q. apply H, (G l L Pl). lra. }
    assert (Weak : forall l, (l < N)%nat -> P l -> 0 <= f l s).
    { intros l L Pl. apply Rnot_lt_le. intros H. destruct (Rle_lt_or_eq_dec 0 s S0) as [Sp | <-]; [| pose proof (Start l L Pl); lra].
      destruct (C l s (- f l s)) as [d [D G]]; [lra |]. set (r := Rmax (s / 2) (s - d / 2)).
      assert (R : 0 <= r < s).
      { split; [pose proof (Rmax_l (s / 2) (s - d / 2)); unfold r; lra | unfold r; apply Rmax_lub_lt; lra]. }
      assert (Rd : Rabs (r - s) < d).
      { rewrite Rabs_left by lra. pose proof (Rmax_r (s / 2) (s - d / 2)). unfold r. lra. }
      specialize (G r). simpl in G. unfold R_dist, D_x, no_cond in G.
      assert (X : Rabs (f l r - f l s) < - f l s) by (apply G; repeat split; [lra | exact Rd]).
      pose proof (Before l r L Pl R). pose proof (Rle_abs (f l r - f l s)). lra. }
    destruct (classic (exists k, (k < N)%nat /\ P k /\ f k s = 0)) as [[k [K [Pk Z]]] | None].
    + exists s, k. repeat split; assumption.
    + exfalso. assert (Pos : forall l, (l < N)%nat -> P l -> 0 < f l s).
      { intros l L Pl. destruct (Weak l L Pl) as [H | H]; [exact H |]. exfalso. apply None. now exists l. }
      assert (Sl : s < 1).
      { destruct S1 as [H | ->]; [exact H |]. pose proof (Pos k0 K0 P0). lra. }
      destruct (small_finite (fun l e => P l -> forall r, s <= r <= s + e -> 0 < f l r) N) as [e [E G]].
      { intros l L. destruct (classic (P l)) as [Pl | Pl]; [| exists 1; split; [lra | intros d _ Q; now elim Pl]].
        destruct (C l s (f l s) (Pos l L Pl)) as [d [D G]]. exists (d / 2). split; [lra |]. intros e Ee _ r R.
        destruct (Req_dec r s) as [-> | Ne]; [now apply Pos |].
        specialize (G r). simpl in G. unfold R_dist, D_x, no_cond in G.
        assert (X : Rabs (f l r - f l s) < f l s) by (apply G; repeat split; [lra | rewrite Rabs_pos_eq by lra; lra]).
        apply Rabs_def2 in X. lra. }
      set (e' := Rmin e (1 - s)). assert (E' : 0 < e' <= e) by (unfold e'; split; [apply Rmin_pos; lra | apply Rmin_l]).
      assert (s + e' <= s); [| lra]. apply Ub. split; [pose proof (Rmin_r e (1 - s)); unfold e' in *; lra |].
      intros l L Pl r R. destruct (Rlt_le_dec r s) as [Q | Q]; [now apply Before |].
      apply (G e' E' l L Pl). lra.
Qed.

(* Sure, from one choice p on: there ij is an edge of the hull, its rectangles are apart, and each site with possible
   edges to both is surely oriented. Then all others are strictly on the left, for every choice. *)
Theorem sure_edge N B i j p : (i < N)%nat -> (j < N)%nat -> choice N B p ->
  (forall x, inside x (B i) -> ~ inside x (B j)) -> (forall k, (k < N)%nat -> 0 <= orient (p i) (p j) (p k)) ->
  (forall k, (k < N)%nat -> k <> i -> k <> j -> possible_edge N B i k -> possible_edge N B j k ->
    surely_oriented (B i) (B j) (B k)) ->
  forall q, choice N B q -> forall k, (k < N)%nat -> k <> i -> k <> j -> 0 < orient (q i) (q j) (q k).
Proof.
  intros I J P Apart Left Sure q Q k K Ki Kj.
  assert (Touch : forall r, choice N B r -> (forall l, (l < N)%nat -> 0 <= orient (r i) (r j) (r l)) ->
    forall l, (l < N)%nat -> l <> i -> l <> j -> orient (r i) (r j) (r l) <> 0).
  { intros r R Lr l L Li Lj Z. apply (surely_oriented_nonzero (B i) (B j) (B l) (r i) (r j) (r l)); auto.
    assert (D : r i <> r j) by (intros E; apply (Apart (r i)); [now apply R | rewrite E; now apply R]).
    assert (Zi : orient (r i) (r j) (r i) = 0) by (unfold orient; ring).
    assert (Zj : orient (r i) (r j) (r j) = 0) by (unfold orient; ring).
    apply Sure; try assumption.
    - destruct (left_half_plane N r (pair i l) (r i) (r j) D Lr) as [u [m H]]; [intros n _ [-> | ->]; assumption |].
      now exists r, u, m.
    - destruct (left_half_plane N r (pair j l) (r i) (r j) D Lr) as [u [m H]]; [intros n _ [-> | ->]; assumption |].
      now exists r, u, m. }
  apply Rnot_le_lt. intros Bad.
  set (f l t := orient (mix t (p i) (q i)) (mix t (p j) (q j)) (mix t (p l) (q l))).
  assert (At : forall t, 0 <= t <= 1 -> choice N B (fun l => mix t (p l) (q l))).
  { intros t T l L. apply inside_convex; [exact T | now apply P | now apply Q]. }
  destruct (first_zero f (fun l => l <> i /\ l <> j) N) as [s [l [S [L [[Li Lj] [Z W]]]]]].
  - intros l. unfold f, orient, mix. simpl. reg.
  - intros l L [Li Lj]. unfold f. rewrite !mix_0. pose proof (Touch p P Left l L Li Lj). pose proof (Left l L). lra.
  - exists k. split; [exact K |]. split; [now split |]. unfold f. rewrite !mix_1. exact Bad.
  - apply (Touch _ (At s S)) with l; try assumption. intros n Hn.
    destruct (Nat.eq_dec n i) as [-> | Ni]; [unfold orient; lra |].
    destruct (Nat.eq_dec n j) as [-> | Nj]; [unfold orient; lra |]. exact (W n Hn (conj Ni Nj)).
Qed.

(* And only then: a choice is the representatives'; orientations are sure; rectangles that meet have no line of their own. *)
Theorem sure_edge_only N B i j : (i < N)%nat -> (j < N)%nat -> i <> j -> (exists k, (k < N)%nat /\ k <> i /\ k <> j) ->
  (forall q, choice N B q -> forall k, (k < N)%nat -> k <> i -> k <> j -> 0 < orient (q i) (q j) (q k)) ->
  (forall x, inside x (B i) -> ~ inside x (B j)) /\
  (forall p, choice N B p -> forall k, (k < N)%nat -> 0 <= orient (p i) (p j) (p k)) /\
  (forall k, (k < N)%nat -> k <> i -> k <> j -> surely_oriented (B i) (B j) (B k)).
Proof.
  intros I J D [k [K [Ki Kj]]] H. split; [| split].
  - intros x X Y. set (q := set_point (set_point (fun m => nearest x (B m)) j x) i x).
    assert (Q : choice N B q) by (repeat (apply set_choice; [| assumption]); apply choice_nearest).
    pose proof (H q Q k K Ki Kj) as O. unfold q in O. rewrite set_same in O. rewrite (set_other _ i x j) in O by congruence.
    rewrite set_same in O. unfold orient in O. lra.
  - intros p P l L. destruct (Nat.eq_dec l i) as [-> | Li]; [unfold orient; lra |].
    destruct (Nat.eq_dec l j) as [-> | Lj]; [unfold orient; lra |]. left. now apply H.
  - intros l L Li Lj. left. intros a b c A C E.
    set (q := set_point (set_point (set_point (fun m => nearest a (B m)) l c) j b) i a).
    assert (Q : choice N B q) by (repeat (apply set_choice; [| assumption]); apply choice_nearest).
    pose proof (H q Q l L Li Lj) as O. unfold q in O. rewrite set_same in O. rewrite (set_other _ i a j) in O by congruence.
    rewrite set_same in O. rewrite (set_other _ i a l Li), (set_other _ j b l Lj), set_same in O. exact O.
Qed.
