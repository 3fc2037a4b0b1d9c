(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Births: a pair is an edge of some choice of points that move by at most t, half-planes included, exactly from half of
   the supremum's opposite on [TOL-1]. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Cells Legal Nerve Crossing Tolerance.
Open Scope R_scope.

Lemma dot_moved u y z : dot u y <= dot u z + dist (0, 0) u * dist y z.
Proof. pose proof (dot_moves u y z). pose proof (Rle_abs (dot u y - dot u z)). lra. Qed.

(* The point at a distance from z along u. *)
Definition along (u : point) (t : R) (z : point) : point := (fst z + t * fst u, snd z + t * snd u).

Lemma along_dist u t z : 0 <= t -> dist z (along u t z) = t * dist (0, 0) u.
Proof.
  intros T. unfold dist. replace (dist2 z (along u t z)) with (t * t * dist2 (0, 0) u) by (unfold dist2, along; simpl; ring).
  rewrite sqrt_mult by (try apply dist2_nonneg; nra). now rewrite sqrt_square.
Qed.

Lemma along_dot u t z : dot u (along u t z) = dot u z + t * (dist (0, 0) u * dist (0, 0) u).
Proof. rewrite dist_sq. unfold dot, along, dist2. simpl. ring. Qed.

(* Towards c by at most t, down to a distance; away from c by t. *)
Lemma nearer_by t c z r : 0 <= r <= dist c z -> dist c z - r <= t -> exists w, dist z w <= t /\ dist c w = r.
Proof.
  intros R0 T. destruct (Req_dec (dist c z) 0) as [Z | Z].
  - exists z. rewrite dist_self. lra.
  - pose proof (dist_nonneg c z) as P. set (d := dist c z) in *. exists (mix (r / d) c z).
    assert (E : r / d * d = r) by (field; exact Z). assert (0 < d) by lra.
    assert (Q : 0 <= r / d <= 1) by (split; nra). rewrite dist_sym, dist_mix_right, dist_mix_left by lra. fold d. lra.
Qed.

Lemma farther_by t c z : 0 <= t -> exists w, dist z w <= t /\ dist c w = dist c z + t.
Proof.
  intros T. destruct (Req_dec (dist c z) 0) as [Z | Z].
  - apply dist_zero in Z. subst z. exists (along (1, 0) t c). rewrite along_dist, dist_self by exact T.
    replace (dist (0, 0) (1, 0)) with 1; [lra |]. unfold dist, dist2. simpl. symmetry.
    replace (_ + _) with 1 by ring. apply sqrt_1.
  - pose proof (dist_nonneg c z) as P. set (d := dist c z) in *. assert (D : 0 < d) by lra. exists (mix (1 + t / d) c z).
    assert (E : t / d * d = t) by (field; exact Z). assert (0 <= t / d) by nra. split.
    + rewrite <- (mix_1 c z) at 1. rewrite dist_mix_mix. fold d.
      replace (1 - (1 + t / d)) with (- (t / d)) by ring. rewrite Rabs_Ropp, Rabs_pos_eq by lra. lra.
    + rewrite dist_mix_left by lra. fold d. lra.
Qed.

Section Birth.
Variables (N : nat) (p : nat -> point) (i j : nat).
Variables (Hi : (i < N)%nat) (Hj : (j < N)%nat).

Theorem disc_birth t : 0 <= t ->
  ((exists q, moved N t p q /\ disc_edge N q i j) <-> rooms N p i j everybody (- (2 * t))).
Proof.
  intros T. split.
  - intros [q [M [c [r [R0 [On Out]]]]]]. exists c. intros k K _ _ _.
    pose proof (On i Hi (or_introl eq_refl)). pose proof (On j Hj (or_intror eq_refl)). pose proof (Out k K).
    pose proof (M i Hi). pose proof (M j Hj). pose proof (M k K).
    pose proof (dist_triangle c (q i) (p i)). pose proof (dist_triangle c (q j) (p j)). pose proof (dist_triangle c (p k) (q k)).
    rewrite (dist_sym (q i)), (dist_sym (q j)) in *. lra.
  - intros [c0 H0]. destruct (bisector_suffices N p i j everybody _ c0 H0) as [c [E H]]. clear c0 H0.
    set (r := dist c (p i)) in *. set (s := Rmax (r - t) 0).
    assert (S0 : 0 <= s) by apply Rmax_r. assert (S1 : r - t <= s) by apply Rmax_l.
    assert (S2 : s <= r) by (apply Rmax_lub; [lra | apply dist_nonneg]).
    destruct (finite_choice (0, 0) (fun k w => dist (p k) w <= t /\ (pair i j k -> dist c w = s) /\ s <= dist c w) N) as [q Q].
    { intros k K. destruct (classic (pair i j k)) as [Y | Y].
      - assert (D : dist c (p k) = r) by (destruct Y as [-> | ->]; [reflexivity | now symmetry]).
        destruct (nearer_by t c (p k) s) as [w [W1 W2]]; [lra | lra |]. exists w. split; [exact W1 |].
        split; [now intros | lra].
      - assert (Di : k <> i) by (intros ->; apply Y; now left). assert (Dj : k <> j) by (intros ->; apply Y; now right).
        destruct (H k K Logic.I Di Dj) as [H1 _]. fold r in H1.
        destruct (farther_by t c (p k) T) as [w [W1 W2]]. exists w. split; [exact W1 |]. split; [now intros |].
        rewrite W2. pose proof (dist_nonneg c (p k)). apply Rmax_lub; lra. }
    exists q. split; [intros k K; now apply Q |].
    assert (D : empty_disc N q (pair i j) c s) by (split; intros k K; apply (Q k K)).
    destruct (Rle_lt_or_eq_dec _ _ S0) as [P | Z]; [now exists c, s |]. rewrite <- Z in D.
    destruct (positive_disc N q (pair i j) c D) as [c' [r' [P D']]]. now exists c', r'.
Qed.

Variable differ : p i <> p j.

(* Both ends of the bisector, and half-planes through moved points. *)
Lemma end_half_plane side t : side * side = 1 -> 0 <= t -> room_at_end N p i j everybody side (- (2 * t)) ->
  exists q u m, moved N t p q /\ empty_half_plane N q (pair i j) u m.
Proof.
  intros Sq T H. pose proof (dist_pos _ _ differ) as P. set (l := dist (p i) (p j)) in *.
  set (u := (side * - (snd (p j) - snd (p i)), side * (fst (p j) - fst (p i)))).
  assert (U : dist (0, 0) u = l).
  { apply dist_eq. unfold dist2, u. simpl. transitivity (side * side * dist2 (p i) (p j)); [unfold dist2; ring | rewrite Sq; unfold dist2; ring]. }
  assert (L2 : l * l = dist2 (p i) (p j)) by apply dist_sq.
  assert (Eij : dot u (p i) = dot u (p j)) by (unfold dot, u; simpl; ring).
  assert (En : forall k, dot u (p k) = dot u (p i) + side * line_n p i j k) by (intros k; unfold dot, u, line_n; simpl; ring).
  destruct (finite_choice (0, 0) (fun k w => dist (p k) w <= t /\
    (pair i j k -> dot u w = dot u (p i) + t * l) /\ dot u w <= dot u (p i) + t * l) N) as [q Q].
  { intros k K. destruct (classic (pair i j k)) as [Y | Y].
    - exists (along u (t / l) (p k)). assert (T' : 0 <= t / l) by (apply Rmult_le_pos; [lra | left; now apply Rinv_0_lt_compat]).
      rewrite along_dist, along_dot, U by exact T'.
      replace (t / l * (l * l)) with (t * l) by (field; lra). replace (t / l * l) with t by (field; lra).
      assert (dot u (p k) = dot u (p i)) by (destruct Y as [-> | ->]; [reflexivity | now symmetry]).
      split; [lra |]. split; [intros; lra | lra].
    - assert (Di : k <> i) by (intros ->; apply Y; now left). assert (Dj : k <> j) by (intros ->; apply Y; now right).
      pose proof (H k K Logic.I Di Dj) as X. fold l in X.
      assert (X' : side * line_n p i j k <= 2 * t * l).
      { apply (Rmult_le_compat_r l) in X; [| lra].
        replace (- side * (line_n p i j k / l) * l) with (- (side * line_n p i j k)) in X by (field; lra). lra. }
      set (v := (- fst u, - snd u)). exists (along v (t / l) (p k)).
      assert (T' : 0 <= t / l) by (apply Rmult_le_pos; [lra | left; now apply Rinv_0_lt_compat]).
      assert (V : dist (0, 0) v = l) by (rewrite <- U; apply dist_eq; unfold dist2, v; simpl; ring).
      rewrite along_dist, V by exact T'. replace (t / l * l) with t by (field; lra). split; [lra |]. split; [now intros |].
      assert (F : dot u (along v (t / l) (p k)) = dot u (p k) - t / l * (l * l)).
      { transitivity (dot u (p k) - t / l * (dist (0, 0) u * dist (0, 0) u)); [| now rewrite U].
        rewrite dist_sq. unfold dot, along, v, dist2. simpl. ring. }
      rewrite F, En. replace (t / l * (l * l)) with (t * l) by (field; lra). lra. }
  exists q, u, (dot u (p i) + t * l). split; [intros k K; now apply Q |]. split.
  - intros Z. rewrite Z, dist_self in U. lra.
  - split; intros k K; apply (Q k K).
Qed.

Lemma half_plane_rooms t q u m e : 0 < e -> moved N t p q -> empty_half_plane N q (pair i j) u m ->
  rooms N p i j everybody (- (2 * t) - e).
Proof.
  intros E M [U [On Out]].
  assert (P : 0 < dist (0, 0) u) by (apply dist_pos; congruence). set (l := dist (0, 0) u) in *.
  assert (Le : forall k, (k < N)%nat -> dot u (p k) <= m + t * l).
  { intros k K. pose proof (dot_moved u (p k) (q k)) as X. fold l in X. pose proof (M k K). pose proof (Out k K). nra. }
  assert (Ge : forall k, (k < N)%nat -> pair i j k -> m - t * l <= dot u (p k)).
  { intros k K Y. pose proof (dot_moved u (q k) (p k)) as X. fold l in X. rewrite (dist_sym (q k)) in X.
    pose proof (M k K). pose proof (On k K Y). nra. }
  (* the centre far out along u: a site nearer than x - height is not far below it *)
  set (a k := dot u (p k) / l - dot u (p i) / l).
  set (b := dist2 (p i) (p j)). assert (B0 : 0 <= b) by apply dist2_nonneg.
  set (x := Rabs (a j) + b / e + 1). set (c := along u (x / l) (p i)).
  assert (Be : 0 <= b / e) by (apply Rmult_le_pos; [exact B0 | left; now apply Rinv_0_lt_compat]).
  assert (X0 : 0 < x) by (unfold x; pose proof (Rabs_pos (a j)); lra).
  assert (Dc : forall k, dist2 c (p k) = (x - a k) * (x - a k) + (dist2 (p i) (p k) - a k * a k)).
  { intros k. assert (L2 : l * l = fst u * fst u + snd u * snd u) by (unfold l; rewrite dist_sq; unfold dist2; simpl; ring).
    assert (A : a k * l = fst u * (fst (p k) - fst (p i)) + snd u * (snd (p k) - snd (p i))) by (unfold a, dot; field; lra).
    assert (Y : x / l * l = x) by (field; lra).
    transitivity ((x / l * l) * (x / l * l) - 2 * (x / l) * (a k * l) + dist2 (p i) (p k)).
    - rewrite A. replace (x / l * l * (x / l * l)) with (x / l * (x / l) * (l * l)) by ring. rewrite L2.
      unfold c, along, dist2. simpl. ring.
    - replace (2 * (x / l) * (a k * l)) with (2 * (x / l * l) * a k) by ring. rewrite Y. ring. }
  assert (Cs : forall k, a k * a k <= dist2 (p i) (p k)).
  { intros k. rewrite <- dist_sq. pose proof (dot_moved u (p k) (p i)) as X1. pose proof (dot_moved u (p i) (p k)) as X2.
    fold l in X1, X2. rewrite (dist_sym (p k)) in X1. set (d := dist (p i) (p k)) in *.
    assert (A : a k * l = dot u (p k) - dot u (p i)) by (unfold a; field; lra). assert (0 <= d) by apply dist_nonneg.
    assert (- d <= a k <= d) by (split; nra). nra. }
  assert (Low : forall k, x - a k <= dist c (p k)).
  { intros k. apply le_of_squares; [apply dist_nonneg |]. rewrite dist_sq, Dc. pose proof (Cs k). lra. }
  assert (Hi' : dist c (p i) <= x).
  { apply le_of_squares; [lra |]. rewrite dist_sq, Dc. replace (dist2 (p i) (p i)) with 0 by (unfold dist2; ring).
    replace (a i) with 0 by (unfold a; ring). lra. }
  assert (Hj' : dist c (p j) <= x - a j + e).
  { assert (X1 : b / e + 1 <= x - a j) by (unfold x; pose proof (Rle_abs (a j)); lra).
    apply le_of_squares; [lra |]. rewrite dist_sq, Dc. fold b.
    assert (b <= e * (x - a j)).
    { assert (b = e * (b / e)) by (field; lra). nra. }
    pose proof (Rle_0_sqr (a j)) as Y. unfold Rsqr in Y. nra. }
  exists c. intros k K _ _ _. pose proof (Low k) as Lk. pose proof (Le k K) as Uk.
  pose proof (Ge i Hi (or_introl eq_refl)) as Gi. pose proof (Ge j Hj (or_intror eq_refl)) as Gj.
  assert (Ak : a k * l = dot u (p k) - dot u (p i)) by (unfold a; field; lra).
  assert (Aj : a j * l = dot u (p j) - dot u (p i)) by (unfold a; field; lra).
  assert (a k <= 2 * t) by nra. assert (a k - a j <= 2 * t) by nra. lra.
Qed.

Theorem birth_is_half w t : is_lub (rooms N p i j everybody) w -> 0 <= t ->
  ((exists q, moved N t p q /\ weak_edge N q i j) <-> - w / 2 <= t).
Proof.
  intros W T. pose proof W as [Ub Lub]. split.
  - intros [q [M [D | [u [m D]]]]].
    + assert (- (2 * t) <= w); [| lra]. apply Ub, disc_birth; [exact T |]. now exists q.
    + apply Rnot_lt_le. intros L. pose proof (half_plane_rooms t q u m (- (2 * t) - w) ltac:(lra) M D) as R.
      assert (X : rooms N p i j everybody (- (2 * t) - (- (2 * t) - w) / 2)).
      { apply (half_plane_rooms t q u m); [lra | exact M | exact D]. }
      pose proof (Ub _ X). lra.
  - intros L. destruct (supremum_on_bisector N p i j differ everybody w W) as [[s R] | H].
    + destruct (proj2 (disc_birth t T)) as [q [M D]].
      { exists (at_s p i j s). intros k K Y Di Dj. destruct (R k K Y Di Dj). lra. }
      exists q. split; [exact M | now left].
    + assert (X : exists side, side * side = 1 /\ room_at_end N p i j everybody side (- (2 * t))).
      { destruct H as [H | H]; [exists 1 | exists (-1)]; (split; [ring |]); intros k K Y Di Dj;
          pose proof (H k K Y Di Dj); lra. }
      destruct X as [side [Sq R]]. destruct (end_half_plane side t Sq T R) as [q [u [m [M D]]]].
      exists q. split; [exact M | right; now exists u, m].
Qed.
End Birth.
