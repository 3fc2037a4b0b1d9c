(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Scott continuity: along streams of nested rectangles every strict statement about the limit is found at some stage.
   The limit may be any rectangle, a point in particular. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation.
Open Scope R_scope.

(* Each end of X is within e of the same end of Y. *)
Definition close (e : R) (X Y : rect) : Prop :=
  Rabs (xlo X - xlo Y) <= e /\ Rabs (xhi X - xhi Y) <= e /\ Rabs (ylo X - ylo Y) <= e /\ Rabs (yhi X - yhi Y) <= e.

(* Stage n has the rectangles B n; they are nested and converge to those of L. *)
Definition nested (N : nat) (B : nat -> sites) : Prop := forall n, refined N (B (S n)) (B n).
Definition converges (N : nat) (B : nat -> sites) (L : sites) : Prop :=
  forall k e, (k < N)%nat -> 0 < e -> late (fun n => close e (B n k) (L k)).
Definition limit (N : nat) (B : nat -> sites) (L : sites) : Prop := nested N B /\ converges N B L.

Lemma abs_le x e : Rabs x <= e -> - e <= x <= e.
Proof. intros H. pose proof (Rle_abs x). pose proof (Rle_abs (- x)) as G. rewrite Rabs_Ropp in G. lra. Qed.

Lemma clamp_near lo hi lo' hi' t e : lo <= hi -> lo' <= t <= hi' -> Rabs (lo - lo') <= e -> Rabs (hi - hi') <= e ->
  Rabs (t - clamp lo hi t) <= e.
Proof.
  intros H T A B. pose proof (Rle_abs (lo - lo')). pose proof (Rle_abs (-(hi - hi'))) as C. rewrite Rabs_Ropp in C.
  assert (0 <= e) by (pose proof (Rabs_pos (lo - lo')); lra).
  unfold clamp, Rmax, Rmin. apply Rabs_le. destruct (Rle_dec hi t); destruct (Rle_dec lo _); lra.
Qed.

Lemma close_sym e X Y : close e X Y -> close e Y X.
Proof. intros [A [H [C D]]]. unfold close. rewrite (Rabs_minus_sym (xlo Y)), (Rabs_minus_sym (xhi Y)),
  (Rabs_minus_sym (ylo Y)), (Rabs_minus_sym (yhi Y)). tauto. Qed.

(* A point of Y has a point of X near it. *)
Lemma close_point e X Y z : close e X Y -> inside z Y -> dist z (nearest z X) <= 2 * e.
Proof.
  intros [A [H [C D]]] [Zx Zy]. pose proof (dist_le_sum z (nearest z X)) as S. unfold nearest in *. simpl in *.
  pose proof (clamp_near _ _ _ _ _ e (x_ordered X) Zx A H). pose proof (clamp_near _ _ _ _ _ e (y_ordered X) Zy C D). lra.
Qed.

Lemma ds_close e X Y c : close e X Y -> ds c X <= ds c Y + 2 * e.
Proof.
  intros H. pose proof (close_point e X Y (nearest c Y) H (nearest_inside c Y)).
  pose proof (ds_le c X _ (nearest_inside (nearest c Y) X)).
  pose proof (dist_triangle c (nearest c Y) (nearest (nearest c Y) X)). unfold ds at 2. lra.
Qed.

Lemma dl_close e X Y c : close e X Y -> dl c Y <= dl c X + 2 * e.
Proof.
  intros H. pose proof (close_point e X Y (farthest c Y) H (farthest_inside c Y)).
  pose proof (le_dl c X _ (nearest_inside (farthest c Y) X)).
  pose proof (dist_triangle c (nearest (farthest c Y) X) (farthest c Y)).
  rewrite (dist_sym (nearest _ X)) in *. unfold dl at 1. lra.
Qed.

(* Strict comparisons at the limit hold at all late stages. *)
Lemma late_less N B L i j c : limit N B L -> (i < N)%nat -> (j < N)%nat ->
  dl c (L i) < ds c (L j) -> late (fun n => dl c (B n i) < ds c (B n j)).
Proof.
  intros [_ K] I J H. set (e := (ds c (L j) - dl c (L i)) / 5). assert (E : 0 < e) by (unfold e; lra).
  destruct (late_and _ _ (K i e I E) (K j e J E)) as [n A]. exists n. intros m M. destruct (A m M) as [X Y].
  pose proof (dl_close e (L i) (B m i) c (close_sym _ _ _ X)). pose proof (ds_close e (L j) (B m j) c (close_sym _ _ _ Y)).
  unfold e in *. lra.
Qed.

Lemma refines_ends X Y : refines X Y -> xlo Y <= xlo X /\ xhi X <= xhi Y /\ ylo Y <= ylo X /\ yhi X <= yhi Y.
Proof.
  intros H. pose proof (x_ordered X). pose proof (y_ordered X).
  destruct (H (xlo X, ylo X)) as [A C]; [unfold inside; simpl; lra |].
  destruct (H (xhi X, yhi X)) as [D E]; [unfold inside; simpl; lra |]. simpl in *. lra.
Qed.

Lemma later_refines N B m n : nested N B -> (m <= n)%nat -> refined N (B n) (B m).
Proof.
  intros H. induction 1 as [| n M IH]; intros k K z Z; [exact Z |]. apply IH; [exact K |]. now apply H.
Qed.

(* The limit has at least the information of each stage. *)
Lemma limit_refines N B L n : limit N B L -> refined N L (B n).
Proof.
  intros [S K] k Hk z [Zx Zy].
  assert (G : forall e, 0 < e -> xlo (B n k) - e <= fst z <= xhi (B n k) + e /\ ylo (B n k) - e <= snd z <= yhi (B n k) + e).
  { intros e E. destruct (K k e Hk E) as [m M]. destruct (M (Nat.max m n)) as [A [D [F G]]]; [lia |].
    destruct (refines_ends _ _ (later_refines N B n (Nat.max m n) S ltac:(lia) k Hk)) as [P [Q [U V]]].
    apply abs_le in A, D, F, G. lra. }
  assert (H : forall u v, (forall e, 0 < e -> u - e <= v) -> u <= v).
  { intros u v W. apply Rnot_lt_le. intros X. pose proof (W ((u - v) / 2)). lra. }
  unfold inside. repeat split; apply H; intros e E; specialize (G e E); lra.
Qed.

Theorem int_limit N B L i c : limit N B L -> (i < N)%nat -> (int N L i c <-> exists n, int N (B n) i c).
Proof.
  intros K I. split.
  - intros H. destruct (late_finite (fun j n => j <> i -> dl c (B n i) < ds c (B n j)) N) as [n A].
    { intros j J. destruct (Nat.eq_dec j i) as [-> | D].
      - exists 0%nat. now intros.
      - destruct (late_less N B L i j c K I J (H j J D)) as [n A]. exists n. intros m M _. now apply A. }
    exists n. intros j J D. now apply (A n).
  - intros [n H]. apply (int_monotone N L (B n)); [exact I | now apply limit_refines | exact H].
Qed.

Theorem ext_limit N B L i c : limit N B L -> (i < N)%nat -> (ext N L i c <-> exists n, ext N (B n) i c).
Proof.
  intros K I. split.
  - intros [j [J [D H]]]. destruct (late_less N B L j i c K J I H) as [n A]. exists n, j.
    repeat split; [exact J | exact D | now apply A].
  - intros [n H]. apply (ext_monotone N L (B n)); [exact I | now apply limit_refines | exact H].
Qed.

Corollary pos_limit N B L i c : limit N B L -> (i < N)%nat -> (pos N L i c <-> forall n, pos N (B n) i c).
Proof.
  intros K I. pose proof (ext_limit N B L i c K I) as E. split.
  - intros H n. apply NNPP. intros C. apply ext_complement_of_pos in C.
    assert (X : ext N L i c) by (apply E; now exists n). exact (proj1 (ext_complement_of_pos N L i c) X H).
  - intros H. apply NNPP. intros C. apply ext_complement_of_pos, E in C as [n C].
    exact (proj1 (ext_complement_of_pos N (B n) i c) C (H n)).
Qed.

(* A witness at the limit is one at all late stages. *)
Theorem witness_limit N B L i j c : limit N B L -> (i < N)%nat -> (j < N)%nat ->
  (witness N L i j c <-> exists n, witness N (B n) i j c).
Proof.
  intros K I J. split.
  - intros H. destruct (late_finite (fun k n => k <> i -> k <> j ->
      dl c (B n i) < ds c (B n k) /\ dl c (B n j) < ds c (B n k)) N) as [n A].
    { intros k Hk. destruct (classic (k <> i /\ k <> j)) as [[Di Dj] | D].
      - destruct (H k Hk Di Dj) as [X Y].
        destruct (late_and _ _ (late_less N B L i k c K I Hk X) (late_less N B L j k c K J Hk Y)) as [n A].
        exists n. intros m M _ _. now apply A.
      - exists 0%nat. intros m _ Di Dj. exfalso. now apply D. }
    exists n. intros k Hk. now apply (A n).
  - intros [n H]. apply (witness_monotone N L (B n)); [exact I | exact J | now apply limit_refines | exact H].
Qed.

Theorem legal_limit N B L i j : limit N B L -> (i < N)%nat -> (j < N)%nat ->
  (legal N L i j <-> exists n, legal N (B n) i j).
Proof.
  intros K I J. split.
  - intros [c W]. apply (witness_limit N B L i j c K I J) in W as [n W]. now exists n, c.
  - intros [n [c W]]. exists c. apply (witness_limit N B L i j c K I J). now exists n.
Qed.
