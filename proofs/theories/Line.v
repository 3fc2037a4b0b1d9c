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

(* ---- in the order of lower ends ---- *)

(* Two sites at all: the pair is legal, and possible. *)
Theorem two_sites B : legal 2 B 0 1 /\ possible 2 B 0 1.
Proof.
  split; [exists (0, 0) | left; exists (0, 0)]; intros k K K0 K1; exfalso; lia.
Qed.

Section Order.
Variables (N : nat) (B : sites) (n : point) (h : R) (u : point).
Variable line : on_line N B n h.
(* u is not across the line. *)
Variable along : fst n * snd u - snd n * fst u <> 0.

Definition low (k : nat) : R := dot u (lowest u (B k)).
Definition high (k : nat) : R := dot u (highest u (B k)).

Lemma in_extent k z : inside z (B k) -> low k <= dot u z <= high k.
Proof. intros Z. split; [now apply lowest_spec | now apply highest_spec]. Qed.

Lemma same_place p q : dot n p = dot n q -> dot u p = dot u q -> p = q.
Proof.
  intros En Eu. unfold dot in En, Eu. set (w := fst n * snd u - snd n * fst u) in *.
  assert (X : w * (fst p - fst q) = 0).
  { replace (w * (fst p - fst q)) with (snd u * (fst n * fst p + snd n * snd p - (fst n * fst q + snd n * snd q)) -
      snd n * (fst u * fst p + snd u * snd p - (fst u * fst q + snd u * snd q))) by (unfold w; ring).
    rewrite En, Eu. ring. }
  assert (Y : w * (snd p - snd q) = 0).
  { replace (w * (snd p - snd q)) with (fst n * (fst u * fst p + snd u * snd p - (fst u * fst q + snd u * snd q)) -
      fst u * (fst n * fst p + snd n * snd p - (fst n * fst q + snd n * snd q))) by (unfold w; ring).
    rewrite En, Eu. ring. }
  apply Rmult_integral in X, Y. destruct X as [X | X]; [contradiction |]. destruct Y as [Y | Y]; [contradiction |].
  rewrite (surjective_pairing p), (surjective_pairing q). f_equal; lra.
Qed.

(* The rectangle of k has a point between points of those of i and j iff their extents say so. *)
Lemma amid_extents i j k : (i < N)%nat -> (j < N)%nat -> (k < N)%nat ->
  (exists z, inside z (B k) /\ amid (B i) (B j) z) <->
  (low k <= Rmax (high i) (high j) /\ Rmin (low i) (low j) <= high k).
Proof.
  intros I J K. destruct line as [_ L]. split.
  - intros [z [Z [a [b [A [C [t [T E]]]]]]]]. pose proof (in_extent k z Z) as Ez.
    assert (Q : forall p, inside p (B i) \/ inside p (B j) ->
      Rmin (low i) (low j) <= dot u p <= Rmax (high i) (high j)).
    { intros p [P | P]; pose proof (in_extent _ p P); pose proof (Rmin_l (low i) (low j));
        pose proof (Rmin_r (low i) (low j)); pose proof (Rmax_l (high i) (high j));
        pose proof (Rmax_r (high i) (high j)); lra. }
    pose proof (Q a A). pose proof (Q b C). rewrite E, dot_mix in Ez. split; nra.
  - intros [X Y].
    assert (Lo : exists a, (inside a (B i) \/ inside a (B j)) /\ dot u a = Rmin (low i) (low j)).
    { unfold Rmin. destruct (Rle_dec (low i) (low j)); [exists (lowest u (B i)) | exists (lowest u (B j))];
        (split; [| reflexivity]); [left | right]; apply lowest_spec. }
    assert (Up : exists b, (inside b (B i) \/ inside b (B j)) /\ dot u b = Rmax (high i) (high j)).
    { unfold Rmax. destruct (Rle_dec (high i) (high j)); [exists (highest u (B j)) | exists (highest u (B i))];
        (split; [| reflexivity]); [right | left]; apply highest_spec. }
    destruct Lo as [a [Ia Ea]]. destruct Up as [b [Ib Eb]].
    set (m := Rmax (low k) (Rmin (low i) (low j))).
    assert (Lk : low k <= high k) by (destruct (in_extent k _ (proj1 (lowest_spec u (B k)))); unfold low in *; lra).
    assert (Ab : dot u a <= dot u b).
    { rewrite Ea, Eb. apply Rle_trans with (low i); [apply Rmin_l |]. apply Rle_trans with (high i); [| apply Rmax_l].
      destruct (in_extent i _ (proj1 (lowest_spec u (B i)))). unfold low in *. lra. }
    assert (M : low k <= m <= high k /\ dot u a <= m <= dot u b).
    { assert (low k <= m) by (unfold m; apply Rmax_l). assert (Rmin (low i) (low j) <= m) by (unfold m; apply Rmax_r).
      rewrite Ea in *. repeat split; try lra; unfold m; apply Rmax_lub; lra. }
    destruct M as [Mk Mab]. destruct (line_meets_rect u (B k) m Mk) as [z [Z Ez]].
    exists z. split; [exact Z |]. exists a, b. split; [exact Ia |]. split; [exact Ib |].
    assert (On : forall w, inside w (B i) \/ inside w (B j) -> dot n w = h) by (intros w [W | W]; eauto).
    destruct (Req_dec (dot u a) (dot u b)) as [E | E].
    + exists 0. split; [lra |]. rewrite mix_0. apply same_place; [| lra]. rewrite (On a Ia). now apply (L k).
    + set (t := (m - dot u a) / (dot u b - dot u a)).
      assert (0 < / (dot u b - dot u a)) by (apply Rinv_0_lt_compat; lra). exists t. split.
      * unfold t. split; [apply Rmult_le_pos; lra |]. apply (Rmult_le_reg_r (dot u b - dot u a)); [lra |].
        unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra.
      * apply same_place; rewrite dot_mix.
        -- rewrite (On a Ia), (On b Ib), (L k z K Z). ring.
        -- rewrite Ez. unfold t. field. lra.
Qed.

(* The sites are numbered by their lower ends. *)
Variable sorted : forall a b, (a <= b)%nat -> (b < N)%nat -> low a <= low b.

Lemma low_high k : low k <= high k.
Proof. destruct (in_extent k _ (proj1 (lowest_spec u (B k)))). unfold low in *. lra. Qed.

Theorem only_neighbours a b : (S a < b)%nat -> (b < N)%nat -> ~ legal N B a b.
Proof.
  intros A Hb Le. rewrite (line_legal N B n h a b line) in Le by lia.
  destruct (amid_extents a b (S a)) as [_ X]; try lia. destruct X as [z [Z M]].
  - pose proof (sorted (S a) b ltac:(lia) Hb). pose proof (low_high b). pose proof (Rmax_r (high a) (high b)).
    pose proof (sorted a (S a) ltac:(lia) ltac:(lia)). pose proof (low_high (S a)). pose proof (Rmin_l (low a) (low b)).
    split; lra.
  - apply (Le (S a) z); auto; lia.
Qed.

Theorem neighbours_legal a : (S a < N)%nat ->
  (legal N B a (S a) <-> (forall k, (k < a)%nat -> high k < low a) /\
    ((S (S a) < N)%nat -> Rmax (high a) (high (S a)) < low (S (S a)))).
Proof.
  intros A. rewrite (line_legal N B n h a (S a) line) by lia.
  assert (Mn : Rmin (low a) (low (S a)) = low a) by (apply Rmin_left, sorted; lia).
  split.
  - intros H. split; intros; apply Rnot_le_lt; intros X.
    + destruct (amid_extents a (S a) k) as [_ M]; try lia. destruct M as [z [Z M]]; [| apply (H k z); auto; lia].
      rewrite Mn. split; [| exact X]. pose proof (sorted k a ltac:(lia) ltac:(lia)). pose proof (low_high a).
      pose proof (Rmax_l (high a) (high (S a))). lra.
    + destruct (amid_extents a (S a) (S (S a))) as [_ M]; try lia.
      destruct M as [z [Z M]]; [| apply (H (S (S a)) z); auto; lia].
      rewrite Mn. split; [exact X |]. pose proof (sorted a (S (S a)) ltac:(lia) ltac:(lia)).
      pose proof (low_high (S (S a))). lra.
  - intros [Before After] k z K Ka Kb Z M. destruct (amid_extents a (S a) k) as [X _]; try lia.
    destruct X as [X Y]; [now exists z |]. rewrite Mn in Y. destruct (Nat.lt_ge_cases k a) as [L | L].
    + specialize (Before k L). lra.
    + assert (S (S a) < N)%nat as Q by lia. specialize (After Q). pose proof (sorted (S (S a)) k ltac:(lia) K). lra.
Qed.
End Order.
