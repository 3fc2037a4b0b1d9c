(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Deaths: what the climb stops at is the supremum, where f is not negative there; a positive supremum is such a place
   [TOL-2]. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Legal Path Tolerance ToleranceNear ToleranceCorners.
Open Scope R_scope.

Section Pair.
Variables (N : nat) (p : nat -> point) (i j : nat).
Variable differ : p i <> p j.
Let room := room N p i j.
Let rooms := rooms N p i j.
Let at_s := at_s p i j.
Let n := line_n p i j.
Let m := line_m p i j.
Let jj : R := dist2 (p i) (p j).
Let r (s : R) : R := dist (at_s s) (p i).
Let far (k : nat) (s : R) : R := dist (at_s s) (p k).

(* g of k, and its derivative, (s jj - n) / far - s jj / r, times these two distances. *)
Definition above (k : nat) (s : R) : R := far k s - r s.
Definition trend (k : nat) (s : R) : R := (s * jj - n k) * r s - s * jj * far k s.

Lemma jj_positive : 0 < jj.
Proof. unfold jj. rewrite <- dist_sq. pose proof (dist_pos _ _ differ). nra. Qed.

Lemma r_square s : r s * r s = jj * (/ 4 + s * s).
Proof. unfold r. rewrite dist_sq. apply bisector_radius. Qed.

Lemma far_square k s : far k s * far k s = r s * r s + m k - 2 * n k * s.
Proof. unfold far, r. rewrite !dist_sq. pose proof (bisector_line p i j s k) as L. unfold at_s, m, n. lra. Qed.

Lemma r_positive s : 0 < r s.
Proof.
  pose proof jj_positive. pose proof (r_square s). assert (0 <= r s) by apply dist_nonneg.
  destruct (Req_dec (r s) 0) as [Z | Z]; [rewrite Z in *; nra | lra].
Qed.

(* The radius is over its tangent. *)
Lemma r_tangent s t : jj * (/ 4 + s * t) <= r s * r t.
Proof.
  pose proof jj_positive as J. pose proof (r_positive s). pose proof (r_positive t).
  destruct (Rle_dec 0 (/ 4 + s * t)) as [P | P]; [| nra].
  apply le_of_squares; [apply Rmult_le_pos; lra |].
  replace (r s * r t * (r s * r t)) with ((r s * r s) * (r t * r t)) by ring. rewrite !r_square.
  pose proof (Rle_0_sqr (s - t)) as X. unfold Rsqr in X.
  replace (jj * (/ 4 + s * s) * (jj * (/ 4 + t * t)))
    with (jj * (/ 4 + s * t) * (jj * (/ 4 + s * t)) + jj * jj * ((s - t) * (s - t)) / 4) by field.
  assert (0 <= jj * jj * ((s - t) * (s - t))) by (apply Rmult_le_pos; [nra | exact X]). lra.
Qed.

(* Its sign without roots, where both terms have one sign: the difference of their squares. *)
Lemma trend_squares k s : (s * jj - n k) * r s * ((s * jj - n k) * r s) - s * jj * far k s * (s * jj * far k s) =
  jj * (s * s * (n k * n k - jj * m k) - s * n k * jj / 2 + n k * n k / 4).
Proof.
  replace ((s * jj - n k) * r s * ((s * jj - n k) * r s)) with ((s * jj - n k) * (s * jj - n k) * (r s * r s)) by ring.
  replace (s * jj * far k s * (s * jj * far k s)) with (s * jj * (s * jj) * (far k s * far k s)) by ring.
  rewrite far_square, r_square. field.
Qed.

(* Where g is not negative and falls towards one side, it is never as high on that side. *)
Lemma trend_tangent k s t : 0 <= above k s ->
  r s * (far k t * far k t) <= r s * ((r t + above k s) * (r t + above k s)) + 2 * ((t - s) * trend k s).
Proof.
  intros V. set (v := above k s) in *. pose proof (r_positive s) as Rs. pose proof (r_positive t) as Rt.
  assert (F : far k s = r s + v) by (unfold v, above; ring). rewrite far_square. unfold trend. rewrite F.
  pose proof (far_square k s) as E. rewrite F in E. pose proof (r_tangent s t) as T.
  assert (Tv : v * (jj * (/ 4 + s * t)) <= v * (r s * r t)) by (apply Rmult_le_compat_l; lra).
  assert (Q4 : v * (r s * r s) = v * (jj * (/ 4 + s * s))) by (rewrite r_square; ring).
  assert (E2 : m k = 2 * v * r s + v * v + 2 * n k * s) by lra. rewrite E2. lra.
Qed.

Theorem trend_bounds k s t : 0 <= above k s -> (t - s) * trend k s <= 0 -> above k t <= above k s.
Proof.
  intros V D. pose proof (trend_tangent k s t V) as T. pose proof (r_positive s). pose proof (r_positive t).
  assert (G : far k t <= r t + above k s); [| unfold above in *; lra].
  apply le_of_squares; [lra |]. apply (Rmult_le_reg_l (r s)); lra.
Qed.

Theorem trend_bounds_strictly k s t : 0 <= above k s -> (t - s) * trend k s < 0 -> above k t < above k s.
Proof.
  intros V D. pose proof (trend_tangent k s t V) as T. pose proof (r_positive s). pose proof (r_positive t).
  assert (G : far k t < r t + above k s); [| unfold above in *; lra].
  apply Rnot_le_lt. intros L.
  assert ((r t + above k s) * (r t + above k s) <= far k t * far k t) by (apply Rmult_le_compat; lra).
  assert (r s * ((r t + above k s) * (r t + above k s)) <= r s * (far k t * far k t)) by (apply Rmult_le_compat_l; lra). lra.
Qed.

Lemma room_says (S : nat -> Prop) k v t : (k < N)%nat -> S k -> k <> i -> k <> j -> room S v (at_s t) -> v <= above k t.
Proof. intros K Sk Di Dj H. destruct (H k K Sk Di Dj) as [A _]. unfold above, far, r. lra. Qed.

Lemma bisector_decides S v : (forall u t, room S u (at_s t) -> u <= v) -> forall u, rooms S u -> u <= v.
Proof.
  intros H u [c R]. destruct (bisector_suffices N p i j S u c R) as [c' [E R']].
  destruct (bisector_is_line p i j differ c' E) as [t ->]. now apply (H u t).
Qed.

(* A place where a line that does not fall and one that does not rise are both lowest: a crossing, or, both being one, a
   summit of its g. *)
Theorem crossing_is_supremum S k l s : other N i j S k -> other N i j S l -> 0 <= above k s -> above l s = above k s ->
  0 <= trend k s -> trend l s <= 0 -> room S (above k s) (at_s s) -> is_lub (rooms S) (above k s).
Proof.
  intros [K [Sk [Ki Kj]]] [L [Sl [Li Lj]]] V E Up Down H. split.
  - unfold is_upper_bound. apply bisector_decides. intros u t R. destruct (Rle_dec t s) as [T | T].
    + pose proof (room_says S k u t K Sk Ki Kj R). pose proof (trend_bounds k s t V) as B.
      assert ((t - s) * trend k s <= 0) by nra. specialize (B ltac:(assumption)). lra.
    + pose proof (room_says S l u t L Sl Li Lj R). pose proof (trend_bounds l s t ltac:(lra)) as B.
      assert ((t - s) * trend l s <= 0) by nra. specialize (B ltac:(assumption)). lra.
  - intros b B. apply B. now exists (at_s s).
Qed.

(* No g is higher than the distance of its point to p i, or to p j. That is attained where p i is between c and P: ... *)
Theorem touch_is_supremum S k s h : other N i j S k -> h = i \/ h = j -> room S (dist (p h) (p k)) (at_s s) ->
  is_lub (rooms S) (dist (p h) (p k)).
Proof.
  intros [K [Sk [Ki Kj]]] Eh H. split.
  - intros u [c R]. destruct (R k K Sk Ki Kj) as [A B]. pose proof (dist_triangle c (p h) (p k)).
    destruct Eh as [-> | ->]; lra.
  - intros b B. apply B. now exists (at_s s).
Qed.

(* ... at s = n / (2 P.J), where P.J < 0. *)
Lemma touch_place k : let a := (fst (p k) - fst (p i)) * (fst (p j) - fst (p i)) + (snd (p k) - snd (p i)) * (snd (p j) - snd (p i)) in
  a < 0 -> above k (n k / (2 * a)) = dist (p i) (p k).
Proof.
  intros a A. set (c := at_s (n k / (2 * a))). pose proof jj_positive as J.
  assert (E : p i = mix (jj / (jj - 2 * a)) c (p k)).
  { apply injective_projections; unfold c, at_s, Tolerance.at_s, n, line_n, jj, dist2, mix in *; simpl;
      unfold a in *; field; lra. }
  set (t := jj / (jj - 2 * a)) in *. assert (T : 0 <= t <= 1).
  { assert (0 < / (jj - 2 * a)) by (apply Rinv_0_lt_compat; lra). split; [unfold t; apply Rmult_le_pos; lra |].
    apply (Rmult_le_reg_r (jj - 2 * a)); [lra |]. unfold t, Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  unfold above, far, r. fold c. rewrite E at 1 2. rewrite dist_mix_left, dist_mix_right by lra. ring.
Qed.

(* An end at which a line rises as long as it is: n^2 >= |J|^2 m. *)
Theorem end_is_supremum S k side : side * side = 1 -> other N i j S k -> 0 <= - side * n k -> jj * m k <= n k * n k ->
  room_at_end N p i j S side (- side * (n k / dist (p i) (p j))) ->
  is_lub (rooms S) (- side * (n k / dist (p i) (p j))).
Proof.
  intros Q [K [Sk [Ki Kj]]] V M H. pose proof (dist_pos _ _ differ) as P. pose proof (dist_sq (p i) (p j)) as Sq. fold jj in Sq.
  set (size := dist (p i) (p j)) in *. set (v := - side * (n k / size)) in *.
  assert (Ev : v * size = - side * n k) by (unfold v; field; lra).
  assert (V0 : 0 <= v) by nra.
  assert (Vv : v * v * jj = n k * n k).
  { rewrite <- Sq. transitivity ((v * size) * (v * size)); [ring |]. rewrite Ev.
    transitivity (side * side * (n k * n k)); [ring | rewrite Q; ring]. }
  assert (J : 0 < jj) by apply jj_positive. assert (Mv : m k <= v * v) by nra.
  split.
  - unfold is_upper_bound. apply bisector_decides. intros u t R.
    pose proof (room_says S k u t K Sk Ki Kj R) as U. pose proof (r_positive t) as Rt.
    assert (G : far k t <= r t + v); [| unfold above in U; lra].
    apply le_of_squares; [lra |]. rewrite far_square.
    assert (Big : - n k * t <= v * r t).
    { assert (St : size * Rabs t <= r t).
      { apply le_of_squares; [lra |]. rewrite r_square, <- Sq. pose proof (Rle_abs t).
        replace (size * Rabs t * (size * Rabs t)) with (size * size * (Rabs t * Rabs t)) by ring.
        rewrite <- Rabs_mult, Rabs_pos_eq by apply Rle_0_sqr. nra. }
      assert (v * (size * Rabs t) <= v * r t) by (apply Rmult_le_compat_l; lra).
      replace (v * (size * Rabs t)) with ((v * size) * Rabs t) in * by ring. rewrite Ev in *.
      assert (Sd : side = 1 \/ side = -1) by (destruct (Rle_dec 0 side); [left | right]; nra).
      pose proof (Rle_abs t). pose proof (Rle_abs (- t)) as B. rewrite Rabs_Ropp in B.
      destruct Sd as [-> | ->]; nra. }
    lra.
  - intros b B. apply Rnot_lt_le. intros L.
    pose proof (B _ (end_is_approached N p i j differ S side v ((v - b) / 2) ltac:(lra) Q H)). lra.
Qed.

(* g and its trend change without jumps. *)
Lemma distance_continuous x : continuity (fun s => dist (at_s s) x).
Proof.
  assert (X : forall s, at_s s = mix s (at_s 0) (at_s 1)) by (intros s; unfold at_s, Tolerance.at_s, mix; simpl; f_equal; ring).
  apply (lipschitz_continuous (dist (at_s 0) (at_s 1))). intros s t. rewrite (X s), (X t). apply lipschitz_dist.
Qed.

Lemma above_continuous k : continuity (above k).
Proof. apply continuity_minus; apply distance_continuous. Qed.

Lemma trend_continuous k : continuity (trend k).
Proof.
  assert (L : forall a b, continuity (fun s => s * a - b)) by (intros a b; reg).
  apply continuity_minus; apply continuity_mult; try apply distance_continuous; [apply L |].
  apply continuity_mult; [apply derivable_continuous, derivable_id | now apply continuity_const].
Qed.

(* Near a place where all lowest lines rise (or all fall: side is -1), f is higher next to it. *)
Lemma way_up S s side w : side * side = 1 -> 0 < w -> room S w (at_s s) ->
  (forall k, other N i j S k -> above k s = w -> 0 < side * trend k s) -> exists t, forall k, other N i j S k -> w < above k t.
Proof.
  intros Q W H Up.
  assert (X : near s (fun t => forall k, (k < N)%nat -> other N i j S k -> 0 < side * (t - s) -> w < above k t)).
  { apply all_near. intros k K. destruct (classic (other N i j S k)) as [O | O];
      [| exists 1; split; [lra |]; intros t _ Y; contradiction].
    pose proof O as [_ [Sk [Ki Kj]]]. pose proof (room_says S k w s K Sk Ki Kj H) as L.
    destruct (Req_dec (above k s) w) as [E | E].
    - pose proof (near_positive (fun t => side * trend k t) s) as P.
      assert (C : continuity (fun t => side * trend k t)) by (apply (continuity_scal (trend k)), trend_continuous).
      pose proof (near_positive (above k) s (above_continuous k) ltac:(lra)) as Pa.
      pose proof (near_and _ _ _ (P C (Up k O E)) Pa) as Y. revert Y. apply near_weaken. intros t [Y1 Y2] _ T.
      rewrite <- E. apply trend_bounds_strictly; [lra |].
      assert (Z : 0 < side * (t - s) * (side * trend k t)) by now apply Rmult_lt_0_compat.
      replace (side * (t - s) * (side * trend k t)) with (side * side * ((t - s) * trend k t)) in Z by ring.
      rewrite Q in Z. lra.
    - assert (Pos : 0 < above k s - w) by lra.
      assert (C : continuity (fun t => above k t - w)) by (apply continuity_minus; [apply above_continuous | now apply continuity_const]).
      pose proof (near_positive _ s C Pos) as Y. revert Y. apply near_weaken. intros t Y _ _. lra. }
  destruct X as [e [E G]]. exists (s + side * e). intros k O.
  assert (Sd : side = 1 \/ side = -1) by (destruct (Rle_dec 0 side); [left | right]; nra).
  apply (G (s + side * e)); [| apply O | exact O |].
  - replace (s + side * e - s) with (side * e) by ring. apply Rabs_le. destruct Sd as [-> | ->]; lra.
  - replace (side * (s + side * e - s)) with (side * side * e) by ring. rewrite Q. lra.
Qed.

(* A positive supremum is where a lowest line does not fall and a lowest one does not rise (both may be one), or at an end. *)
Theorem who_binds S w : is_lub (rooms S) w -> 0 < w -> (exists k, other N i j S k) ->
  (exists s k l, room S w (at_s s) /\ other N i j S k /\ other N i j S l /\ above k s = w /\ above l s = w /\
    0 <= trend k s /\ trend l s <= 0) \/ room_at_end N p i j S 1 w \/ room_at_end N p i j S (-1) w.
Proof.
  intros [Ub Lub] W [k0 O0].
  destruct (supremum_on_bisector N p i j differ S w (conj Ub Lub)) as [[s H] | H]; [left | now right].
  assert (No : forall t, ~ forall k, other N i j S k -> w < above k t).
  { intros t Y.
    destruct (finite_min (other N i j S) (fun k => above k t) N) as [k [_ [O L]]]; [exists k0; split; [apply O0 | exact O0] |].
    assert (Z : rooms S (above k t)).
    { exists (at_s t). intros l Hl Sl Li Lj. pose proof (L l Hl (conj Hl (conj Sl (conj Li Lj)))) as X.
      pose proof (as_far p i j t) as F. unfold above, far, r, at_s in *. lra. }
    pose proof (Ub _ Z). pose proof (Y k O). lra. }
  assert (Rise : exists k, other N i j S k /\ above k s = w /\ 0 <= trend k s).
  { apply NNPP. intros Ne. destruct (way_up S s (-1) w) as [t Y]; [ring | exact W | exact H | | now apply (No t)].
    intros k O E. apply Rnot_le_lt. intros L. apply Ne. exists k. split; [exact O |]. split; [exact E | lra]. }
  assert (Fall : exists l, other N i j S l /\ above l s = w /\ trend l s <= 0).
  { apply NNPP. intros Ne. destruct (way_up S s 1 w) as [t Y]; [ring | exact W | exact H | | now apply (No t)].
    intros k O E. apply Rnot_le_lt. intros L. apply Ne. exists k. split; [exact O |]. split; [exact E | lra]. }
  destruct Rise as [k [Ok [Ek Tk]]]. destruct Fall as [l [Ol [El Tl]]]. exists s, k, l. exact (conj H (conj Ok (conj Ol (conj Ek (conj El (conj Tk Tl)))))).
Qed.
End Pair.
