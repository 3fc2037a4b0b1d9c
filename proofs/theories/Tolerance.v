(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Tolerances: all points move at once, each by at most t. The death of an edge, and that the bisector suffices [TOL-1]. *)
From Coq Require Import Reals Lra Lia Psatz Classical FunctionalExtensionality.
From Dyadel Require Import Plane Finite Cells Legal.
Open Scope R_scope.

(* Each point is at most t from where it is listed. *)
Definition moved (N : nat) (t : R) (p q : nat -> point) : Prop := forall k, (k < N)%nat -> dist (p k) (q k) <= t.

Lemma dist2_sym a b : dist2 a b = dist2 b a.
Proof. unfold dist2. ring. Qed.

Lemma between_of_abs x e : Rabs x <= e -> - e <= x <= e.
Proof. intros H. pose proof (Rle_abs x). pose proof (Rle_abs (- x)). rewrite Rabs_Ropp in *. lra. Qed.

(* A linear form changes by no more than its length times the way. *)
Lemma dot_moves u y z : Rabs (dot u y - dot u z) <= dist (0, 0) u * dist y z.
Proof.
  apply le_of_squares; [apply Rmult_le_pos; apply dist_nonneg |].
  rewrite <- Rabs_mult, Rabs_pos_eq by apply Rle_0_sqr.
  replace (dist (0, 0) u * dist y z * (dist (0, 0) u * dist y z))
    with ((dist (0, 0) u * dist (0, 0) u) * (dist y z * dist y z)) by ring.
  rewrite !dist_sq. unfold dist2, dot. simpl.
  pose proof (Rle_0_sqr (fst u * (snd y - snd z) - snd u * (fst y - fst z))) as X. unfold Rsqr in X. lra.
Qed.

(* The distance to a point is convex. *)
Lemma dist_convex t a b z : 0 <= t <= 1 -> dist (mix t a b) z <= (1 - t) * dist a z + t * dist b z.
Proof.
  intros T. pose proof (dist_nonneg a z). pose proof (dist_nonneg b z).
  apply le_of_squares; [assert (0 <= (1 - t) * dist a z) by (apply Rmult_le_pos; lra);
    assert (0 <= t * dist b z) by (apply Rmult_le_pos; lra); lra |].
  rewrite dist_sq, (dist2_sym _ z), dist2_mix, !(dist2_sym z), <- (dist_sq a z), <- (dist_sq b z), <- (dist_sq a b).
  pose proof (dist_triangle_rev a z b) as U. pose proof (dist_triangle_rev b z a) as V.
  rewrite (dist_sym z b) in U. rewrite (dist_sym z a), (dist_sym b a) in V.
  set (d := dist a b) in *. set (x := dist a z) in *. set (y := dist b z) in *.
  assert (W : (x - y) * (x - y) <= d * d) by nra.
  apply (Rmult_le_compat_l (t * (1 - t))) in W; [lra | nra].
Qed.

(* Where x is nearer than y by v >= 0, at least, is convex. *)
Lemma nearer_by_convex v t a b x y : 0 <= v -> 0 <= t <= 1 -> dist a x + v <= dist a y -> dist b x + v <= dist b y ->
  dist (mix t a b) x + v <= dist (mix t a b) y.
Proof.
  intros V T X Y. pose proof (dist_nonneg a x). pose proof (dist_nonneg b x). pose proof (dist_convex t a b x T) as D.
  pose proof (nearer_affine t a b x y) as E. rewrite <- !dist_sq in E.
  assert (A1 : 2 * v * dist a x + v * v <= dist a y * dist a y - dist a x * dist a x) by nra.
  assert (B1 : 2 * v * dist b x + v * v <= dist b y * dist b y - dist b x * dist b x) by nra.
  apply (Rmult_le_compat_l (1 - t)) in A1; [| lra]. apply (Rmult_le_compat_l t) in B1; [| lra].
  apply (Rmult_le_compat_l (2 * v)) in D; [| lra].
  apply le_of_squares; [apply dist_nonneg | lra].
Qed.

(* A minimum of finitely many continuous functions and a number. *)
Lemma continuity_min f g : continuity f -> continuity g -> continuity (fun s => Rmin (f s) (g s)).
Proof.
  intros F G. replace (fun s => Rmin (f s) (g s)) with (fun s => (f s + g s - Rabs (f s - g s)) * / 2).
  - apply continuity_mult; [| now apply continuity_const].
    apply continuity_minus; [now apply continuity_plus |].
    apply (continuity_comp (fun s => f s - g s) Rabs); [now apply continuity_minus | apply Rcontinuity_abs].
  - apply functional_extensionality. intros x. unfold Rmin, Rabs.
    destruct (Rle_dec (f x) (g x)); destruct (Rcase_abs (f x - g x)); lra.
Qed.

Lemma capped_minimum (P : nat -> Prop) (g : nat -> R -> R) (W : R) N : (forall k, continuity (g k)) ->
  exists F, continuity F /\ forall s v, v <= F s <-> v <= W /\ forall k, (k < N)%nat -> P k -> v <= g k s.
Proof.
  intros G. induction N as [| N [F [C H]]].
  - exists (fun _ => W). split; [now apply continuity_const |]. intros s v. split; [| tauto].
    intros V. split; [exact V |]. intros k K. lia.
  - destruct (classic (P N)) as [Y | Y].
    + exists (fun s => Rmin (F s) (g N s)). split; [now apply continuity_min |]. intros s v. split.
      * intros V. pose proof (Rmin_l (F s) (g N s)). pose proof (Rmin_r (F s) (g N s)).
        destruct (proj1 (H s v)) as [A B]; [lra |]. split; [exact A |]. intros k K Pk.
        destruct (below_S N k K) as [-> | L]; [lra | now apply B].
      * intros [A B]. apply Rmin_glb; [apply H; split; [exact A |]; intros k K; apply B; lia | apply B; [lia | exact Y]].
    + exists F. split; [exact C |]. intros s v. rewrite H. split; intros [A B]; (split; [exact A |]); intros k K Pk.
      * destruct (below_S N k K) as [-> | L]; [contradiction | now apply B].
      * apply B; [lia | exact Pk].
Qed.

Section Edge.
Variables (N : nat) (p : nat -> point) (i j : nat).

(* At the centre c every other site of S is farther by v, at least, than p i and p j: f(c) >= v. *)
Definition room (S : nat -> Prop) (v : R) (c : point) : Prop := forall k, (k < N)%nat -> S k -> k <> i -> k <> j ->
  dist c (p i) + v <= dist c (p k) /\ dist c (p j) + v <= dist c (p k).
Definition everybody (k : nat) : Prop := True.
Definition rooms (S : nat -> Prop) (v : R) : Prop := exists c, room S v c.

(* A witness for discs of radius t. *)
Definition disc_witness (t : R) (c : point) : Prop := forall k, (k < N)%nat -> k <> i -> k <> j ->
  dist c (p i) + t < dist c (p k) - t /\ dist c (p j) + t < dist c (p k) - t.

(* It makes an edge of every choice. *)
Theorem disc_witness_sound t c q : (i < N)%nat -> (j < N)%nat -> disc_witness t c -> moved N t p q -> strict_edge N q i j.
Proof.
  intros I J W M. apply enclosing_disc_gives_edge with c. intros k K Di Dj. destruct (W k K Di Dj).
  pose proof (M i I). pose proof (M j J). pose proof (M k K). pose proof (dist_triangle c (p i) (q i)).
  pose proof (dist_triangle c (p j) (q j)). pose proof (dist_triangle c (q k) (p k)). rewrite (dist_sym (q k) (p k)) in *. lra.
Qed.

(* Death: there is a witness exactly below half of the supremum w. *)
Theorem death_is_half w t : is_lub (rooms everybody) w -> ((exists c, disc_witness t c) <-> t < w / 2).
Proof.
  intros [Ub Lub]. split.
  - intros [c W].
    destruct (small_finite (fun k d => k <> i -> k <> j ->
      dist c (p i) + (2 * t + d) <= dist c (p k) /\ dist c (p j) + (2 * t + d) <= dist c (p k)) N) as [e [E L]].
    { intros k K. destruct (classic (k <> i /\ k <> j)) as [[Di Dj] | D].
      - destruct (W k K Di Dj). exists (Rmin (dist c (p k) - dist c (p i) - 2 * t) (dist c (p k) - dist c (p j) - 2 * t)).
        split; [apply Rmin_pos; lra |]. intros d Hd _ _.
        pose proof (Rmin_l (dist c (p k) - dist c (p i) - 2 * t) (dist c (p k) - dist c (p j) - 2 * t)).
        pose proof (Rmin_r (dist c (p k) - dist c (p i) - 2 * t) (dist c (p k) - dist c (p j) - 2 * t)). lra.
      - exists 1. split; [lra |]. intros d _ Di Dj. now elim D. }
    assert (2 * t + e <= w); [| lra]. apply Ub. exists c. intros k K _ Di Dj.
    exact (L e (conj E (Rle_refl e)) k K Di Dj).
  - intros T. assert (X : exists v, 2 * t < v /\ rooms everybody v).
    { apply NNPP. intros H. assert (w <= 2 * t); [| lra]. apply Lub. intros v V. apply Rnot_lt_le. intros Y.
      apply H. now exists v. }
    destruct X as [v [V [c R]]]. exists c. intros k K Di Dj. destruct (R k K Logic.I Di Dj). lra.
Qed.

(* Where f is at least v >= 0 is convex: f has one way up [TOL-2]. *)
Theorem room_convex S v a b t : 0 <= v -> 0 <= t <= 1 -> room S v a -> room S v b -> room S v (mix t a b).
Proof.
  intros V T A B k K Sk Di Dj. destruct (A k K Sk Di Dj). destruct (B k K Sk Di Dj). split; now apply nearer_by_convex.
Qed.

(* Moving the centre straight to the farther of p i and p j does not lower f: the bisector suffices. *)
Lemma towards_farther S v c x y : dist c y <= dist c x ->
  (forall k, (k < N)%nat -> S k -> k <> i -> k <> j -> dist c x + v <= dist c (p k)) ->
  exists c', dist c' x = dist c' y /\ forall k, (k < N)%nat -> S k -> k <> i -> k <> j -> dist c' x + v <= dist c' (p k).
Proof.
  intros L H. destruct (shrink c x y L) as [t [T [E F]]]. exists (mix t c x). split; [exact E |]. intros k K Sk Di Dj.
  pose proof (H k K Sk Di Dj). pose proof (dist_triangle c (mix t c x) (p k)) as D. rewrite dist_mix_left in D by lra. lra.
Qed.

Theorem bisector_suffices S v c : room S v c -> exists c', dist c' (p i) = dist c' (p j) /\ room S v c'.
Proof.
  intros H. destruct (Rle_dec (dist c (p j)) (dist c (p i))) as [L | L].
  - destruct (towards_farther S v c (p i) (p j) L) as [c' [E G]]; [intros k K Sk Di Dj; now apply H |].
    exists c'. split; [exact E |]. intros k K Sk Di Dj. rewrite <- E. split; now apply G.
  - destruct (towards_farther S v c (p j) (p i)) as [c' [E G]]; [lra | intros k K Sk Di Dj; now apply H |].
    exists c'. split; [now symmetry |]. intros k K Sk Di Dj. rewrite <- E. split; now apply G.
Qed.

(* The bisector: c(s) = p i + J/2 + s J', J = p j - p i and J' its left turn; the lines m - 2 n s. *)
Let jx : R := fst (p j) - fst (p i).
Let jy : R := snd (p j) - snd (p i).
Definition at_s (s : R) : point := (fst (p i) + jx / 2 - s * jy, snd (p i) + jy / 2 + s * jx).
Definition line_m (k : nat) : R :=
  (fst (p k) - fst (p i)) * (fst (p k) - fst (p i) - jx) + (snd (p k) - snd (p i)) * (snd (p k) - snd (p i) - jy).
Definition line_n (k : nat) : R := - jy * (fst (p k) - fst (p i)) + jx * (snd (p k) - snd (p i)).

Theorem bisector_radius s : dist2 (at_s s) (p i) = dist2 (p i) (p j) * (/ 4 + s * s) /\
  dist2 (at_s s) (p j) = dist2 (p i) (p j) * (/ 4 + s * s).
Proof. unfold dist2, at_s, jx, jy. simpl. split; field. Qed.

Theorem bisector_line s k : dist2 (at_s s) (p k) - dist2 (at_s s) (p i) = line_m k - 2 * line_n k * s.
Proof. unfold dist2, at_s, line_m, line_n, jx, jy. simpl. field. Qed.

Variable differ : p i <> p j.

Theorem bisector_is_line c : dist c (p i) = dist c (p j) -> exists s, c = at_s s.
Proof.
  intros E. apply dist_eq in E. assert (P : 0 < dist2 (p i) (p j)).
  { rewrite <- dist_sq. pose proof (dist_pos _ _ differ). nra. }
  set (q := dist2 (p i) (p j)) in *.
  set (s := (- jy * (fst c - fst (p i)) + jx * (snd c - snd (p i))) / q).
  assert (Sq : s * q = - jy * (fst c - fst (p i)) + jx * (snd c - snd (p i))) by (unfold s; field; lra).
  assert (H : 2 * (jx * (fst c - fst (p i)) + jy * (snd c - snd (p i))) = q).
  { unfold q, jx, jy, dist2 in *. lra. }
  assert (Q : q = jx * jx + jy * jy) by (unfold q, jx, jy, dist2; ring).
  exists s. rewrite (surjective_pairing c). unfold at_s. f_equal; apply (Rmult_eq_reg_l q); try lra; apply Rminus_diag_uniq.
  - transitivity (q * (fst c - fst (p i)) - q * jx / 2 + (s * q) * jy); [field |]. rewrite Sq.
    transitivity (q * (fst c - fst (p i)) - jx / 2 * (2 * (jx * (fst c - fst (p i)) + jy * (snd c - snd (p i))))
      + (- jy * (fst c - fst (p i)) + jx * (snd c - snd (p i))) * jy); [rewrite H; field | rewrite Q; field].
  - transitivity (q * (snd c - snd (p i)) - q * jy / 2 - (s * q) * jx); [field |]. rewrite Sq.
    transitivity (q * (snd c - snd (p i)) - jy / 2 * (2 * (jx * (fst c - fst (p i)) + jy * (snd c - snd (p i))))
      - (- jy * (fst c - fst (p i)) + jx * (snd c - snd (p i))) * jx); [rewrite H; field | rewrite Q; field].
Qed.

(* Towards its ends the bisector's circles become the two half-planes next to the line of p i and p j: k is then beyond
   them by -+ n / |J|. *)
Let gap (k : nat) (s : R) : R := dist (at_s s) (p k) - dist (at_s s) (p i).
Let size : R := dist (p i) (p j).
Definition room_at_end (S : nat -> Prop) (side v : R) : Prop := forall k, (k < N)%nat -> S k -> k <> i -> k <> j ->
  v <= - side * (line_n k / dist (p i) (p j)).

Lemma gap_continuous k : continuity (gap k).
Proof.
  assert (X : forall s, at_s s = mix s (at_s 0) (at_s 1)) by (intros s; unfold at_s, mix; simpl; f_equal; ring).
  apply (lipschitz_continuous (dist (at_s 0) (at_s 1) + dist (at_s 0) (at_s 1))).
  intros s t. unfold gap. rewrite (X s), (X t).
  exact (lipschitz_minus _ _ _ _ (lipschitz_dist (at_s 0) (at_s 1) (p k)) (lipschitz_dist (at_s 0) (at_s 1) (p i)) s t).
Qed.

Lemma radius_range x side : 0 <= x -> side * side = 1 ->
  size * x <= dist (at_s (side * x)) (p i) <= size * (x + / 2).
Proof.
  intros X Q. pose proof (dist_pos _ _ differ) as P. fold size in P. destruct (bisector_radius (side * x)) as [E _].
  rewrite <- !dist_sq in E. fold size in E. set (r := dist (at_s (side * x)) (p i)) in *.
  assert (R0 : 0 <= r) by apply dist_nonneg.
  assert (F : r * r = size * size * (/ 4 + x * x)).
  { rewrite E. replace (side * x * (side * x)) with (side * side * (x * x)) by ring. rewrite Q. ring. }
  assert (0 < size * size) by nra.
  split; apply le_of_squares; nra.
Qed.

Lemma gap_at_end k side e : 0 < e -> side * side = 1 ->
  exists x0, 0 < x0 /\ forall x, x0 <= x -> Rabs (gap k (side * x) + side * (line_n k / size)) <= e.
Proof.
  intros E Q. pose proof (dist_pos _ _ differ) as P. fold size in P.
  set (b := dist (p i) (p k)). set (n := line_n k). set (m := line_m k). set (C := Rabs m + b * b + Rabs n).
  assert (C0 : 0 <= C) by (unfold C; pose proof (Rabs_pos m); pose proof (Rabs_pos n); nra).
  exists (C / (2 * size * e) + 1). split.
  { assert (0 <= C / (2 * size * e)); [| lra]. apply Rmult_le_pos; [exact C0 |]. left. apply Rinv_0_lt_compat. nra. }
  intros x X. assert (X0 : 0 < x).
  { assert (0 <= C / (2 * size * e)); [| lra]. apply Rmult_le_pos; [exact C0 |]. left. apply Rinv_0_lt_compat. nra. }
  assert (Big : C <= 2 * size * x * e).
  { assert (Y : C / (2 * size * e) * (2 * size * e) = C) by (field; lra).
    assert (0 < 2 * size * e) by nra. nra. }
  destruct (radius_range x side (Rlt_le _ _ X0) Q) as [Rl Rh].
  pose proof (bisector_line (side * x) k) as L. fold m n in L. rewrite <- !dist_sq in L. unfold gap.
  pose proof (dist_triangle (at_s (side * x)) (p i) (p k)) as T1. fold b in T1.
  pose proof (dist_triangle (at_s (side * x)) (p k) (p i)) as T2. rewrite (dist_sym (p k) (p i)) in T2. fold b in T2.
  set (r := dist (at_s (side * x)) (p i)) in *. set (g := dist (at_s (side * x)) (p k)) in *.
  set (d := g - r + side * (n / size)).
  assert (Rn : 0 < r) by nra.
  set (y := r / size - x).
  assert (Ey : r = size * (x + y)) by (unfold y; field; lra).
  assert (Y : 0 <= y <= / 2) by (split; nra).
  assert (Ed : 2 * r * d = m - (g - r) * (g - r) + 2 * side * n * y).
  { unfold d. transitivity (g * g - r * r - (g - r) * (g - r) + 2 * side * n * (r / size)); [field; lra |].
    rewrite L. replace (r / size) with (x + y) by (rewrite Ey; field; lra). ring. }
  assert (S1 : Rabs side = 1).
  { unfold Rabs. destruct (Rcase_abs side); nra. }
  assert (Up : Rabs (2 * r * d) <= C).
  { rewrite Ed. unfold C.
    assert (Z : Rabs (2 * side * n * y) <= Rabs n).
    { replace (2 * side * n * y) with (side * n * (2 * y)) by ring. rewrite !Rabs_mult, S1.
      rewrite (Rabs_pos_eq 2), (Rabs_pos_eq y) by lra. pose proof (Rabs_pos n). nra. }
    assert (W : (g - r) * (g - r) <= b * b) by nra.
    assert (W0 : 0 <= (g - r) * (g - r)) by apply Rle_0_sqr.
    set (z := (g - r) * (g - r)) in *. set (o := 2 * side * n * y) in *.
    apply Rle_trans with (Rabs (m - z) + Rabs o); [apply Rabs_triang |].
    apply Rplus_le_compat; [| exact Z]. apply Rle_trans with (Rabs m + Rabs (- z)); [apply Rabs_triang |].
    rewrite Rabs_Ropp, (Rabs_pos_eq z) by exact W0. lra. }
  rewrite Rabs_mult, (Rabs_pos_eq (2 * r)) in Up by lra. fold d.
  apply (Rmult_le_reg_l (2 * r)); [lra |]. pose proof (Rabs_pos d). nra.
Qed.

(* What an end allows is approached on the bisector. *)
Theorem end_is_approached S side v e : 0 < e -> side * side = 1 -> room_at_end S side v -> rooms S (v - e).
Proof.
  intros E Q H.
  destruct (finite_choice 0 (fun k x0 => 0 < x0 /\ forall x, x0 <= x ->
    Rabs (gap k (side * x) + side * (line_n k / size)) <= e) N) as [f F].
  { intros k _. now apply gap_at_end. }
  assert (X : exists x, 0 < x /\ forall k, (k < N)%nat -> f k <= x).
  { clear H. revert F. generalize N as M. induction M as [| M IH]; intros F.
    - exists 1. split; [lra |]. intros k K. lia.
    - destruct IH as [x [X G]]; [intros k K; apply F; lia |]. exists (Rmax x (f M)).
      pose proof (Rmax_l x (f M)). pose proof (Rmax_r x (f M)). split; [lra |].
      intros k K. destruct (below_S M k K) as [-> | L]; [lra |]. pose proof (G k L). lra. }
  destruct X as [x [X G]]. exists (at_s (side * x)). intros k K Sk Di Dj.
  destruct (F k K) as [_ A]. specialize (A x (G k K)). pose proof (H k K Sk Di Dj) as V. fold size in V.
  destruct (bisector_radius (side * x)) as [Bi Bj]. rewrite <- Bi in Bj. apply dist_eq in Bj. rewrite Bj.
  unfold gap in A. apply between_of_abs in A. lra.
Qed.

(* The supremum is attained on the bisector, or at one of its ends. *)
Theorem supremum_on_bisector S w : is_lub (rooms S) w ->
  (exists s, room S w (at_s s)) \/ room_at_end S 1 w \/ room_at_end S (-1) w.
Proof.
  intros [Ub Lub]. apply NNPP. intros H. apply not_or_and in H as [H1 H]. apply not_or_and in H as [H2 H3].
  assert (Far : forall side, side * side = 1 -> ~ room_at_end S side w -> exists x0 v, 0 < x0 /\ v < w /\
    forall x u, x0 <= x -> room S u (at_s (side * x)) -> u <= v).
  { intros side Q Ne. apply not_all_ex_not in Ne as [k Ne]. apply imply_to_and in Ne as [K Ne].
    apply imply_to_and in Ne as [Sk Ne]. apply imply_to_and in Ne as [Di Ne]. apply imply_to_and in Ne as [Dj Ne].
    apply Rnot_le_lt in Ne. fold size in Ne. set (l := - side * (line_n k / size)) in *.
    destruct (gap_at_end k side ((w - l) / 2)) as [x0 [X0 G]]; [lra | exact Q |].
    exists x0, ((w + l) / 2). split; [exact X0 |]. split; [lra |]. intros x u X R.
    destruct (R k K Sk Di Dj) as [R1 _]. specialize (G x X). apply between_of_abs in G. unfold gap in G. unfold l in *. lra. }
  destruct (Far 1) as [x1 [v1 [X1 [V1 G1]]]]; [ring | exact H2 |].
  destruct (Far (-1)) as [x2 [v2 [X2 [V2 G2]]]]; [ring | exact H3 |].
  destruct (capped_minimum (fun k => S k /\ k <> i /\ k <> j) gap w N gap_continuous) as [F [C Hf]].
  assert (Rf : forall s v, v <= w -> (v <= F s <-> room S v (at_s s))).
  { intros s v V. rewrite Hf. destruct (bisector_radius s) as [Bi Bj]. rewrite <- Bi in Bj. apply dist_eq in Bj. split.
    - intros [_ A] k K Sk Di Dj. pose proof (A k K (conj Sk (conj Di Dj))) as Y. unfold gap in Y. lra.
    - intros A. split; [exact V |]. intros k K [Sk [Di Dj]]. destruct (A k K Sk Di Dj). unfold gap. lra. }
  set (x := Rmax x1 x2). assert (A1 : x1 <= x) by apply Rmax_l. assert (A2 : x2 <= x) by apply Rmax_r.
  destruct (continuity_ab_maj F (- x) x) as [s0 [M _]]; [lra | intros c _; apply C |].
  assert (M0 : F s0 < w).
  { apply Rnot_le_lt. intros Y. apply H1. exists s0. now apply Rf; [right |]. }
  assert (w <= Rmax (F s0) (Rmax v1 v2)).
  { apply Lub. intros v [c R]. assert (Vw : v <= w) by (apply Ub; now exists c).
    destruct (bisector_suffices S v c R) as [c' [E R']]. destruct (bisector_is_line c' E) as [s ->].
    destruct (Rle_dec x s) as [Y | Y].
    - assert (v <= v1) by (apply (G1 s v); [lra | now replace (1 * s) with s by ring]).
      pose proof (Rmax_r (F s0) (Rmax v1 v2)). pose proof (Rmax_l v1 v2). lra.
    - destruct (Rle_dec x (- s)) as [Z | Z].
      + assert (v <= v2) by (apply (G2 (- s) v); [lra | now replace (-1 * - s) with s by ring]).
        pose proof (Rmax_r (F s0) (Rmax v1 v2)). pose proof (Rmax_r v1 v2). lra.
      + assert (v <= F s) by (now apply Rf). pose proof (M s ltac:(lra)).
        pose proof (Rmax_l (F s0) (Rmax v1 v2)). lra. }
  assert (Rmax (F s0) (Rmax v1 v2) < w) by (apply Rmax_lub_lt; [exact M0 | now apply Rmax_lub_lt]). lra.
Qed.
End Edge.
