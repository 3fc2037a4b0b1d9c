(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Graphs of nearest neighbours of all choices [NNG-1]. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Nerve Orientation.
Open Scope R_scope.

(* j is nearest to i; the only one. *)
Definition is_nearest (N : nat) (p : nat -> point) (i j : nat) : Prop :=
  forall k, (k < N)%nat -> k <> i -> dist (p i) (p j) <= dist (p i) (p k).
Definition only_nearest (N : nat) (p : nat -> point) (i j : nat) : Prop :=
  forall k, (k < N)%nat -> k <> i -> k <> j -> dist (p i) (p j) < dist (p i) (p k).
Definition may_be_nearest (N : nat) (B : sites) (i j : nat) : Prop := exists p, choice N B p /\ is_nearest N p i j.
Definition surely_is_nearest (N : nat) (B : sites) (i j : nat) : Prop := forall p, choice N B p -> only_nearest N p i j.

(* A disc with no site strictly inside and two on its circle, of any radius, makes a possible pair. *)
Lemma disc_possible N B p i j c r : (i < N)%nat -> (j < N)%nat -> choice N B p -> empty_disc N p (pair i j) c r ->
  possible N B i j.
Proof.
  intros I J P D. left. apply (pair_possible N B i j I J). exists c. exact (disc_shows_possible N B _ p c r P D).
Qed.

(* The nearest one makes a possible pair: the disc with the segment as diameter lies in that about p i. *)
Lemma nearest_is_possible N B p i j : (i < N)%nat -> (j < N)%nat -> choice N B p -> is_nearest N p i j -> possible N B i j.
Proof.
  intros I J P H. apply (disc_possible N B p i j (mix (/ 2) (p i) (p j)) (dist (p i) (p j) / 2) I J P). split.
  - intros k _ [-> | ->].
    + rewrite dist_sym, dist_mix_left by lra. lra.
    + rewrite dist_mix_right by lra. lra.
  - intros k K. destruct (Nat.eq_dec k i) as [-> | D].
    + rewrite (dist_sym (mix _ _ _)), dist_mix_left by lra. lra.
    + pose proof (H k K D). pose proof (dist_triangle (p i) (mix (/ 2) (p i) (p j)) (p k)) as T.
      rewrite dist_mix_left in T by lra. lra.
Qed.

(* Pairs that are not possible are neither. *)
Theorem may_be_nearest_possible N B i j : (i < N)%nat -> (j < N)%nat -> may_be_nearest N B i j -> possible N B i j.
Proof. intros I J [p [P H]]. now apply (nearest_is_possible N B p). Qed.

Theorem surely_nearest_may_be N B i j : surely_is_nearest N B i j -> may_be_nearest N B i j.
Proof.
  intros H. exists (fun k => nearest (0, 0) (B k)). split; [apply choice_nearest |].
  intros k K Di. destruct (Nat.eq_dec k j) as [-> | Dj]; [lra |]. left. now apply (H _ (choice_nearest N B (0, 0))).
Qed.

(* From a place x in R_i: j may be nearest to it iff no site is always nearer; only possible pairs of i matter. *)
Theorem may_be_nearest_exact N B i j : (i < N)%nat -> (j < N)%nat -> i <> j ->
  (may_be_nearest N B i j <-> exists x, inside x (B i) /\
    forall k, (k < N)%nat -> k <> i -> k <> j -> possible N B i k -> ds x (B j) <= dl x (B k)).
Proof.
  intros I J D. split.
  - intros [p [P H]]. exists (p i). split; [now apply P |]. intros k K Di Dj _.
    pose proof (H k K Di). pose proof (ds_le (p i) _ _ (P j J)). pose proof (le_dl (p i) _ _ (P k K)). lra.
  - intros [x [X H]].
    set (p := set_point (set_point (fun k => farthest x (B k)) j (nearest x (B j))) i x).
    assert (Pi : p i = x) by (unfold p; apply set_same).
    assert (Pj : p j = nearest x (B j)) by (unfold p; rewrite set_other by congruence; apply set_same).
    assert (Pk : forall k, k <> i -> k <> j -> p k = farthest x (B k)).
    { intros k Di Dj. unfold p. rewrite set_other by exact Di. now rewrite set_other by exact Dj. }
    assert (P : choice N B p).
    { apply set_choice; [| exact X]. apply set_choice; [apply choice_farthest | apply nearest_inside]. }
    exists p. split; [exact P |]. rename P into Ch. unfold is_nearest. rewrite Pi, Pj.
    change (dist x (nearest x (B j))) with (ds x (B j)).
    destruct (finite_min (fun k => k <> i) (fun k => dist x (p k)) N) as [m [M [Dm L]]]; [now exists j; split; [| auto] |].
    assert (Near : is_nearest N p i m) by (intros k K Dk; rewrite Pi; now apply L).
    pose proof (nearest_is_possible N B p i m I M Ch Near) as Po.
    intros k K Dk. apply Rle_trans with (dist x (p m)); [| now apply L].
    destruct (Nat.eq_dec m j) as [-> | Dj]; [rewrite Pj; apply Rle_refl |].
    rewrite (Pk m Dm Dj). now apply H.
Qed.

(* Surely: strictly nearer than every possible pair of i, from all of R_i; *)
Lemma surely_nearest_places N B i j : (i < N)%nat -> (j < N)%nat -> i <> j ->
  (surely_is_nearest N B i j <-> forall x, inside x (B i) ->
    forall k, (k < N)%nat -> k <> i -> k <> j -> possible N B i k -> dl x (B j) < ds x (B k)).
Proof.
  intros I J D. split.
  - intros H x X k K Di Dj _.
    set (p := set_point (set_point (fun m => nearest x (B m)) j (farthest x (B j))) i x).
    assert (P : choice N B p).
    { apply set_choice; [| exact X]. apply set_choice; [apply choice_nearest | apply farthest_inside]. }
    pose proof (H p P k K Di Dj) as Q. unfold p in Q. rewrite set_same in Q.
    rewrite (set_other _ i x j) in Q by congruence. rewrite set_same in Q.
    rewrite (set_other _ i x k) in Q by exact Di. rewrite set_other in Q by exact Dj. exact Q.
  - intros H p P k K Di Dj. apply Rnot_le_lt. intros C.
    destruct (finite_min (fun m => m <> i /\ m <> j) (fun m => dist (p i) (p m)) N) as [m [M [[Mi Mj] L]]];
      [now exists k |].
    assert (Near : is_nearest N p i m).
    { intros l Hl Dl. destruct (Nat.eq_dec l j) as [-> | Dlj]; [| now apply L].
      pose proof (L k K (conj Di Dj)). lra. }
    pose proof (H (p i) (P i I) m M Mi Mj (nearest_is_possible N B p i m I M P Near)).
    pose proof (le_dl (p i) _ _ (P j J)). pose proof (ds_le (p i) _ _ (P m M)).
    pose proof (L k K (conj Di Dj)). lra.
Qed.

(* which its four corners decide. *)
Lemma nearer_affine_place x u v : dist2 x v - dist2 x u =
  2 * (fst u - fst v) * fst x + 2 * (snd u - snd v) * snd x + (dot v v - dot u u).
Proof. unfold dist2, dot. ring. Qed.

Lemma corners_nearer R X Y : (forall s, corner s R -> dl s X < ds s Y) -> forall x, inside x R -> dl x X < ds x Y.
Proof.
  intros H x I. unfold dl, ds. set (u := farthest x X). set (v := nearest x Y). apply dist_lt.
  assert (0 < 2 * (fst u - fst v) * fst x + 2 * (snd u - snd v) * snd x + (dot v v - dot u u));
    [| rewrite <- nearer_affine_place in *; lra].
  apply affine_on_rect with R; [| exact I]. intros s S. rewrite <- nearer_affine_place.
  pose proof (H s S). pose proof (le_dl s _ _ (farthest_inside x X)) as A. pose proof (ds_le s _ _ (nearest_inside x Y)) as C.
  fold u in A. fold v in C. assert (Q : dist s u < dist s v) by lra. apply dist_lt in Q. lra.
Qed.

Theorem surely_nearest_exact N B i j : (i < N)%nat -> (j < N)%nat -> i <> j ->
  (surely_is_nearest N B i j <-> forall x, corner x (B i) ->
    forall k, (k < N)%nat -> k <> i -> k <> j -> possible N B i k -> dl x (B j) < ds x (B k)).
Proof.
  intros I J D. rewrite surely_nearest_places by assumption. split; intros H x X k K Di Dj P.
  - apply H; try assumption. now apply corner_inside.
  - apply (corners_nearer (B i)); [| exact X]. intros s S. now apply H.
Qed.

(* A site farther from all of R_i than the least bound of dl there counts in neither. *)
Definition out_of_reach (N : nat) (B : sites) (i k : nat) : Prop := exists m b, (m < N)%nat /\ m <> i /\ possible N B i m /\
  (forall z, inside z (B i) -> dl z (B m) <= b /\ b < ds z (B k)).

Theorem reach_decides_may N B i j x : inside x (B i) -> ~ out_of_reach N B i j ->
  (forall k, (k < N)%nat -> k <> i -> k <> j -> possible N B i k -> ~ out_of_reach N B i k -> ds x (B j) <= dl x (B k)) ->
  forall k, (k < N)%nat -> k <> i -> k <> j -> possible N B i k -> ds x (B j) <= dl x (B k).
Proof.
  intros X Fj H. destruct (classic (exists k, (k < N)%nat /\ k <> i /\ k <> j /\ possible N B i k)) as [E | E];
    [| intros k K Di Dj P; exfalso; apply E; now exists k].
  destruct (finite_min (fun k => k <> i /\ k <> j /\ possible N B i k) (fun k => dl x (B k)) N) as [m [M [[Mi [Mj Mp]] L]]].
  { destruct E as [k [K Q]]. now exists k. }
  intros k K Di Dj P. apply Rle_trans with (dl x (B m)); [| now apply L].
  apply Rnot_lt_le. intros C. destruct (classic (out_of_reach N B i m)) as [F | F]; [| pose proof (H m M Mi Mj Mp F); lra].
  destruct F as [l [b [Hl [Li [Lp Q]]]]]. destruct (Q x X). destruct (Nat.eq_dec l j) as [-> | Lj].
  - pose proof (ds_le_dl x (B j)). pose proof (ds_le_dl x (B m)). lra.
  - pose proof (L l Hl (conj Li (conj Lj Lp))). pose proof (ds_le_dl x (B m)). lra.
Qed.

Theorem reach_decides_sure N B i j x : (i < N)%nat -> inside x (B i) ->
  (forall k, (k < N)%nat -> k <> i -> k <> j -> possible N B i k -> ~ out_of_reach N B i k -> dl x (B j) < ds x (B k)) ->
  forall k, (k < N)%nat -> k <> i -> k <> j -> possible N B i k -> dl x (B j) < ds x (B k).
Proof.
  intros I X H. intros k K Di Dj P.
  destruct (finite_min (fun k => k <> i /\ k <> j /\ possible N B i k) (fun k => ds x (B k)) N) as [m [M [[Mi [Mj Mp]] L]]].
  { now exists k. }
  apply Rlt_le_trans with (ds x (B m)); [| now apply L].
  destruct (classic (out_of_reach N B i m)) as [F | F]; [| now apply H].
  destruct F as [l [b [Hl [Li [Lp Q]]]]]. destruct (Q x X). destruct (Nat.eq_dec l j) as [-> | Lj]; [lra |].
  pose proof (L l Hl (conj Li (conj Lj Lp))). pose proof (ds_le_dl x (B l)). lra.
Qed.

Theorem out_of_reach_neither N B i j : (i < N)%nat -> (j < N)%nat -> i <> j -> out_of_reach N B i j ->
  ~ may_be_nearest N B i j.
Proof.
  intros I J D [m [b [M [Mi [P Q]]]]] H. apply (may_be_nearest_exact N B i j I J D) in H. destruct H as [x [X H]].
  destruct (Q x X). destruct (Nat.eq_dec m j) as [-> | Mj].
  - pose proof (ds_le_dl x (B j)). lra.
  - pose proof (H m M Mi Mj P). lra.
Qed.
