(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Sites whose rectangles all lie on one line: every pair is possible, and a pair is legal iff no other rectangle has a
   point between points of the two. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve.
Open Scope R_scope.

Definition on_line (N : nat) (B : sites) (n : point) (h : R) : Prop :=
  n <> (0, 0) /\ forall k z, (k < N)%nat -> inside z (B k) -> dot n z = h.

(* A point of the convex hull of two rectangles on a line. *)
Definition amid (X Y : rect) (z : point) : Prop :=
  exists a b, (inside a X \/ inside a Y) /\ (inside b X \/ inside b Y) /\ between z a b.

Theorem line_possible N B n h i j : on_line N B n h -> (i < N)%nat -> (j < N)%nat -> possible N B i j.
Proof.
  intros [Nz L] I J. right. exists n. split; [exact Nz |]. intros m k M _ K.
  destruct (lowest_spec n (B k)) as [A _]. destruct (highest_spec n (B m)) as [C _].
  rewrite (L k _ K A), (L m _ M C). lra.
Qed.

Lemma legal_not_amid N B i j k z : (i < N)%nat -> (j < N)%nat -> (k < N)%nat -> k <> i -> k <> j ->
  legal N B i j -> inside z (B k) -> ~ amid (B i) (B j) z.
Proof.
  intros I J K Di Dj [c W] Z [a [b [A [C [t [T E]]]]]]. destruct (W k K Di Dj) as [W1 W2].
  pose proof (ds_le c _ _ Z) as Dz. set (r := Rmax (dl c (B i)) (dl c (B j))).
  assert (Q : forall p, inside p (B i) \/ inside p (B j) -> dist c p <= r).
  { intros p [P | P]; pose proof (le_dl c _ _ P); unfold r;
      pose proof (Rmax_l (dl c (B i)) (dl c (B j))); pose proof (Rmax_r (dl c (B i)) (dl c (B j))); lra. }
  assert (dist c z <= r) by (rewrite E; apply disc_convex; [exact T | now apply Q | now apply Q]).
  assert (r < ds c (B k)) by (unfold r; now apply Rmax_lub_lt). lra.
Qed.

(* Coordinates along and across the line. *)
Lemma across n p q : dot n n * dist2 p q =
  (dot n p - dot n q) * (dot n p - dot n q) +
  (dot (- snd n, fst n) p - dot (- snd n, fst n) q) * (dot (- snd n, fst n) p - dot (- snd n, fst n) q).
Proof. unfold dot, dist2. simpl. ring. Qed.

Lemma same_point n p q : n <> (0, 0) -> dot n p = dot n q -> dot (- snd n, fst n) p = dot (- snd n, fst n) q -> p = q.
Proof.
  intros Nz A C. apply dist_zero. pose proof (across n p q) as E. rewrite A, C in E.
  assert (P : 0 < dot n n).
  { destruct n as [x y]. unfold dot. simpl. destruct (Req_dec x 0) as [-> | X]; [| nra].
    destruct (Req_dec y 0) as [-> | Y]; [now elim Nz | nra]. }
  assert (Z : dist2 p q = 0) by (apply (Rmult_eq_reg_l (dot n n)); lra). unfold dist. rewrite Z. apply sqrt_0.
Qed.

Theorem line_legal N B n h i j : on_line N B n h -> (i < N)%nat -> (j < N)%nat ->
  (legal N B i j <-> forall k z, (k < N)%nat -> k <> i -> k <> j -> inside z (B k) -> ~ amid (B i) (B j) z).
Proof.
  intros [Nz L] I J. split.
  { intros H k z K Di Dj Z. now apply (legal_not_amid N B i j k z). }
  intros H. set (d := (- snd n, fst n)).
  assert (P : 0 < dot n n).
  { destruct n as [x y]. unfold dot. simpl. destruct (Req_dec x 0) as [-> | X]; [| nra].
    destruct (Req_dec y 0) as [-> | Y]; [now elim Nz | nra]. }
  destruct (lowest_spec d (B i)) as [Li Mi]. destruct (lowest_spec d (B j)) as [Lj Mj].
  destruct (highest_spec d (B i)) as [Hi Xi]. destruct (highest_spec d (B j)) as [Hj Xj].
  (* the ends of the hull *)
  assert (Lo : exists a, (inside a (B i) \/ inside a (B j)) /\
    forall z, inside z (B i) \/ inside z (B j) -> dot d a <= dot d z).
  { destruct (Rle_dec (dot d (lowest d (B i))) (dot d (lowest d (B j)))).
    - exists (lowest d (B i)). split; [now left |]. intros z [Z | Z]; [now apply Mi | pose proof (Mj z Z); lra].
    - exists (lowest d (B j)). split; [now right |]. intros z [Z | Z]; [pose proof (Mi z Z); lra | now apply Mj]. }
  assert (Up : exists b, (inside b (B i) \/ inside b (B j)) /\
    forall z, inside z (B i) \/ inside z (B j) -> dot d z <= dot d b).
  { destruct (Rle_dec (dot d (highest d (B j))) (dot d (highest d (B i)))).
    - exists (highest d (B i)). split; [now left |]. intros z [Z | Z]; [now apply Xi | pose proof (Xj z Z); lra].
    - exists (highest d (B j)). split; [now right |]. intros z [Z | Z]; [pose proof (Xi z Z); lra | now apply Xj]. }
  destruct Lo as [a [Ia La]]. destruct Up as [b [Ib Ub]].
  assert (On : forall z, inside z (B i) \/ inside z (B j) -> dot n z = h).
  { intros z [Z | Z]; [now apply (L i) | now apply (L j)]. }
  set (c := mix (1 / 2) a b).
  assert (Cn : dot n c = h) by (unfold c; rewrite dot_mix, (On a Ia), (On b Ib); lra).
  assert (Cd : dot d c = (dot d a + dot d b) / 2) by (unfold c; rewrite dot_mix; lra).
  pose proof (La b Ib) as Lab.
  assert (Ac : forall z, dot n z = h -> dot n n * dist2 c z = (dot d c - dot d z) * (dot d c - dot d z)).
  { intros z Z. rewrite across. fold d. rewrite Cn, Z. ring. }
  exists c. intros k K Di Dj.
  set (z := nearest c (B k)). assert (Iz : inside z (B k)) by apply nearest_inside.
  pose proof (L k z K Iz) as Zn. pose proof (H k z K Di Dj Iz) as Off.
  assert (Out : dot d z < dot d a \/ dot d b < dot d z).
  { apply NNPP. intros C. apply Off. exists a, b. split; [exact Ia |]. split; [exact Ib |].
    destruct (Req_dec (dot d a) (dot d b)) as [E | E].
    - exists 0. split; [lra |]. rewrite mix_0. apply (same_point n); [exact Nz | rewrite Zn; symmetry; now apply On |]. fold d. lra.
    - set (t := (dot d z - dot d a) / (dot d b - dot d a)).
      assert (0 < / (dot d b - dot d a)) by (apply Rinv_0_lt_compat; lra).
      exists t. split.
      + unfold t. split; [apply Rmult_le_pos; lra |]. apply (Rmult_le_reg_r (dot d b - dot d a)); [lra |].
        unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra.
      + apply (same_point n); [exact Nz | rewrite dot_mix, Zn, (On a Ia), (On b Ib); ring |]. fold d. rewrite dot_mix.
        unfold t. field. lra. }
  assert (Far : forall q, inside q (B i) \/ inside q (B j) -> dist c q < dist c z).
  { intros q Q. apply dist_lt. pose proof (La q Q). pose proof (Ub q Q). pose proof (Ac q (On q Q)) as Eq. pose proof (Ac z Zn) as Ez.
    apply (Rmult_lt_reg_l (dot n n)); [exact P |]. rewrite Eq, Ez.
    destruct Out as [O | O]; nra. }
  split; [apply (Far (farthest c (B i))) | apply (Far (farthest c (B j)))]; [left | right]; apply farthest_inside.
Qed.
